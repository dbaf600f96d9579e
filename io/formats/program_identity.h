#pragma once
// Which program ran: a log's metadata names it by SHA-256, so that an edited or exchanged file shows.

#include <span>
#include <string>

#include "io/files/mapped_file.h"
#include "log/log.h"
#include "mapping/program_match.h"

namespace clsurf::io {

/// Name without folder, size and SHA-256 of a program's file.
[[nodiscard]] ProgramReference identify(const Source& program);

/// The metadata with `programs` set to these, the rest kept. `metadata`: a JSON object or empty.
[[nodiscard]] std::string with_programs(const std::string& metadata, std::span<const ProgramReference> programs);

/// Whether `program` is one of those that the log names by hash. A text is the same with line ends of another
/// system (LF, CR LF). Adds the warning `log.program` where it is none of them: edited after the run where the
/// name is the same, another one otherwise. O(bytes) for logs that name hashes, O(1) for others.
[[nodiscard]] ProgramIdentity check_identity(const Source& program, const Log& log, Diagnostics& diagnostics);

}  // namespace clsurf::io

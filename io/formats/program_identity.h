#pragma once
// Identifies the program of a log: the metadata give its SHA-256, so that an edited or exchanged file is detected.

#include <span>
#include <string>

#include "io/files/mapped_file.h"
#include "log/log.h"
#include "mapping/program_match.h"

namespace clsurf::io {

/// Name without folder, size and SHA-256 of a program's file.
[[nodiscard]] ProgramReference identify(const Source& program);

/// The metadata with `programs` replaced by these. `metadata`: a JSON object or empty.
[[nodiscard]] std::string with_programs(const std::string& metadata, std::span<const ProgramReference> programs);

/// Whether `program` is one of those that the log names by hash. Line ends (LF, CR LF) are ignored.
/// If it is not, adds the warning `log.program`: the program was edited after the run if the
/// name is the same, otherwise it is another program. O(bytes) for logs with hashes, O(1) for others.
[[nodiscard]] ProgramIdentity check_identity(const Source& program, const Log& log, Diagnostics& diagnostics);

}  // namespace clsurf::io

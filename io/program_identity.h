#pragma once
// Which program ran: a log's metadata names it by SHA-256, so that an edited or exchanged file shows.

#include <span>
#include <string>

#include "io/mapped_file.h"
#include "log/log.h"

namespace clsurf::io {

/// Name without folder, size and SHA-256 of a program's file.
[[nodiscard]] ProgramReference identify(const Source& program);

/// The metadata with `programs` set to these, the rest kept. `metadata`: a JSON object or empty.
[[nodiscard]] std::string with_programs(const std::string& metadata, std::span<const ProgramReference> programs);

/// Adds the warning `log.program` where the log names its programs by hash and `program` is none of
/// them: edited after the run where the name is the same, another one otherwise. O(bytes) for logs
/// that name hashes, O(1) for others.
void check_identity(const Source& program, const Log& log, Diagnostics& diagnostics);

}  // namespace clsurf::io

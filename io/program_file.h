#pragma once
// Programs from files.

#include <string>

#include "io/mapped_file.h"
#include "program/program.h"

namespace clsurf::io {

/// Reads and interprets a program ("-": standard input). `dialect` empty: detected. Subprograms
/// that the program calls by name are looked for beside it.
/// Throws InputError (unreadable, empty, wrong arc, endless loop), UsageError (unknown dialect).
[[nodiscard]] Program read_program(const std::string& path, const std::string& dialect,
                                   bool block_delete = true);
[[nodiscard]] Program read_program(const Source& source, const std::string& dialect,
                                   bool block_delete = true);

}  // namespace clsurf::io

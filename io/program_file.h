#pragma once
// Programs from files.

#include <memory>
#include <string>

#include "io/mapped_file.h"
#include "program/program_reader.h"

namespace clsurf::io {

struct ProgramOptions {
    std::string dialect;       ///< empty: detected
    bool block_delete = true;  ///< skip blocks that begin with '/'
    std::string tools;         ///< path of a tool table (io/tool_table_file.h); empty: none
};

/// Reads and interprets a program ("-": standard input). Subprograms that the program calls by name
/// are looked for beside it.
/// Throws InputError (unreadable, empty, wrong arc, endless loop, tool table), UsageError (unknown dialect).
[[nodiscard]] Program read_program(const std::string& path, const ProgramOptions& options = {});
[[nodiscard]] Program read_program(const Source& source, const ProgramOptions& options = {});
/// The same for who goes through its motions once: they never stand in memory whole.
[[nodiscard]] std::unique_ptr<ProgramReader> open_program(const Source& source, const ProgramOptions& options = {});

}  // namespace clsurf::io

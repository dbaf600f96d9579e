#pragma once
// Programs from files.

#include <memory>
#include <optional>
#include <string>

#include "io/files/mapped_file.h"
#include "program/frame_placement.h"
#include "program/program_reader.h"

namespace clsurf::io {

struct ProgramOptions {
    std::string dialect;       ///< empty: detected
    bool block_delete = true;  ///< skip blocks that begin with '/'
    /// nullopt: each motion in its own work system, as `moves` prints it.
    std::optional<Coordinates> coordinates = Coordinates::workpiece;
    std::optional<Vec3> start;  ///< [mm] as InterpreterOptions has it
    std::string tools;          ///< path of a tool table (io/readers/tool_table_file.h); empty: none
};

/// Reads and interprets a program ("-": standard input). Subprograms that the program calls by name
/// are looked for beside it. Positions are in one coordinate system whatever work offsets the program sets.
/// Throws InputError (unreadable, empty, wrong arc, endless loop, tool table), UsageError (unknown dialect).
[[nodiscard]] Program read_program(const std::string& path, const ProgramOptions& options = {});
[[nodiscard]] Program read_program(const Source& source, const ProgramOptions& options = {});
/// The same for who goes through its motions once: they never stand in memory whole. Positions are the machine's.
[[nodiscard]] std::unique_ptr<ProgramReader> open_program(const Source& source, const ProgramOptions& options = {});

/// Whether a file begins as an NC program does: text, most of its lines blocks or comments. O(1).
[[nodiscard]] bool looks_like_program(const Source& source);

}  // namespace clsurf::io

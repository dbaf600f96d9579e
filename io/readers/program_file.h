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
    /// nullopt: each motion in its own work coordinate system, as `moves` prints it.
    std::optional<Coordinates> coordinates = Coordinates::workpiece;
    std::optional<Vec3> start;  ///< [mm] as in InterpreterOptions
    std::string tools;          ///< path of a tool table (io/readers/tool_table_file.h); empty: none
};

/// Reads and interprets a program ("-": standard input). Subprograms that the program calls by name
/// are searched for in its folder. All positions are in one coordinate system, whatever work offsets the program sets.
/// Throws InputError (unreadable, empty, wrong arc, endless loop, tool table), UsageError (unknown dialect).
[[nodiscard]] Program read_program(const std::string& path, const ProgramOptions& options = {});
[[nodiscard]] Program read_program(const Source& source, const ProgramOptions& options = {});
/// The same for one pass over the motions, which are never all in memory. Positions are the machine's.
[[nodiscard]] std::unique_ptr<ProgramReader> open_program(const Source& source, const ProgramOptions& options = {});

/// Whether a file begins like an NC program: text, mostly blocks and comments. O(1).
[[nodiscard]] bool looks_like_program(const Source& source);

}  // namespace clsurf::io

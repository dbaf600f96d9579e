#pragma once
// The interpreter: blocks → motions. One pass over the text, with a fast path for plain blocks.
//
// Rules: RS274/NGC (NIST IR 6556) with LinuxCNC's extensions for `linuxcnc`; the operator's manuals
// of the controls for the other dialects (docs/formats/programs.md lists what is understood).

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "program/program.h"
#include "program/tool_table.h"

namespace clsurf {

/// Finds the text of a subprogram that is not in the program itself, by its name ("1234", "PROFILE"); nullopt if
/// there is none.
using SubprogramLoader = std::function<std::optional<SourceText>(const std::string& name)>;

struct InterpreterOptions {
    const Dialect* dialect = nullptr;      ///< nullptr: detected from the text
    bool block_delete = true;              ///< skip blocks that begin with '/'
    SubprogramLoader load;                 ///< empty: no other files
    std::uint64_t most_jumps = 5'000'000;  ///< jumps and calls; more is an error: an endless loop
    /// Limit of the motions from loops, repeats and pecks, plus 200 per line. Bounds the memory.
    std::uint64_t most_repeated = 20'000'000;
    /// [mm] Position of the axes before the program, for linuxcnc, whose interpreter knows it: the origin of incremental
    /// words, and the value of coordinates that the program never sets. nullopt: 0, 0, 0. The other dialects know no start.
    std::optional<Vec3> start;
    std::optional<ToolTable> tools;  ///< nullopt: for linuxcnc the table of its stand-alone interpreter, else none
};

/// Interprets a program. Throws InputError with file, line and column: a wrong arc, a malformed block, an endless
/// loop or recursion, a missing subprogram. Other problems are diagnostics `program.…` in the result. O(executed
/// blocks).
[[nodiscard]] Program parse_program(SourceText text, const InterpreterOptions& options);

}  // namespace clsurf

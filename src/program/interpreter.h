#pragma once
// The interpreter: blocks → motions. One pass over the text; plain blocks take a short way.
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

/// Finds the text of a subprogram that the program itself does not contain, by its name ("1234",
/// "PROFILE"); nullopt: there is none.
using SubprogramLoader = std::function<std::optional<SourceText>(const std::string& name)>;

struct InterpreterOptions {
    const Dialect* dialect = nullptr;      ///< nullptr: detected from the text
    bool block_delete = true;              ///< skip blocks that begin with '/'
    SubprogramLoader load;                 ///< empty: no other files
    std::uint64_t most_jumps = 5'000'000;  ///< jumps and calls; more is an error: a loop without end
    /// Motions from loops, repeats and pecks; 200 a line may come on top. Bounds the memory.
    std::uint64_t most_repeated = 20'000'000;
    /// [mm] Where the axes of the machine stand before the program, for linuxcnc, whose interpreter knows it: its incremental
    /// words and coordinates that it never sets count from there. nullopt: 0, 0, 0. The other dialects know no start.
    std::optional<Vec3> start;
    std::optional<ToolTable> tools;  ///< nullopt: for linuxcnc those of its stand-alone interpreter, else none
};

/// Interprets a program. Throws InputError with file, line and column: a wrong arc, a malformed
/// block, an endless loop or recursion, a subprogram that is nowhere. Survivable: diagnostics
/// `program.…` in the result. O(blocks carried out).
[[nodiscard]] Program parse_program(SourceText text, const InterpreterOptions& options);

}  // namespace clsurf

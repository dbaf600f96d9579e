#pragma once
// Tool tables from files, in LinuxCNC's format: one tool per line, letters with numbers, a remark after ';'.
//
//     T1 P1 D6.0 Z12.3 ; ball nose
//
// T: number. P: pocket. D: diameter. X Y Z: tool offsets for G43. I J: front and back angle [deg],
// Q: orientation, of a lathe tool. Lengths are mm. The remark may name the shape of the tool (machined/tool.h). Source:
// LinuxCNC, "Tool Table Format".

#include "io/files/mapped_file.h"
#include "program/tool_table.h"

namespace clsurf::io {

/// Throws InputError with file, line and column: a missing or repeated T, an unknown word, a
/// malformed number, an offset of an unsupported axis (A B C U V W other than 0), no tools.
[[nodiscard]] ToolTable read_tool_table(const Source& source);

}  // namespace clsurf::io

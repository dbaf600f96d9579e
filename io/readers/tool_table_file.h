#pragma once
// Tool tables from files, in LinuxCNC's format: a tool a line, letters with numbers, a remark after ';'.
//
//     T1 P1 D6.0 Z12.3 ; ball nose
//
// T: number. P: pocket. D: diameter. X Y Z: what G43 takes off. I J: front and back angle [deg],
// Q: orientation, of a lathe tool. Lengths are mm. The remark may tell the tool's shape (machined/tool.h). Source: LinuxCNC, "Tool Table Format".

#include "io/files/mapped_file.h"
#include "program/tool_table.h"

namespace clsurf::io {

/// Throws InputError with file, line and column: a missing or repeated T, a word that is not known, a
/// malformed number, an offset of an axis that is not carried on (A B C U V W other than 0), no tools.
[[nodiscard]] ToolTable read_tool_table(const Source& source);

}  // namespace clsurf::io

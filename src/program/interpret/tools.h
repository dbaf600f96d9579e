#pragma once
// Tools: the one in the spindle, their lengths, rows of the tool table.

#include <cstddef>
#include <cstdint>

#include "core/geometry.h"
#include "program/interpret/tool_state.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Rows of the tool table: L1 sets a tool's values; L10 and L11 set the offset so that the present position equals
/// the words, in the active system or (L11) in G59.3 without G92.
void set_tool(Interpreter& in, int level, const Block& block);
/// The tool of the table; a missing one has neither length nor diameter, and is reported.
[[nodiscard]] Tool tool_of(Interpreter& in, int number, std::size_t column);
/// T, M6, M61.
void change_tool(Interpreter& in, const Block& block);
/// From here on the end of the last motion differs from the position: a length was subtracted, or compensation ended
/// next to the programmed point.
void part_from_machine(CompensationState& compensation, std::int64_t motions, const Vec3& by);
/// After a tool change, or after waiting for an input, the interpreter reads the end of the last motion again. The
/// stand-alone one does so without the length that was subtracted since: T1 M6 G43 in one block leaves the position
/// unchanged.
void read_machine_position(Interpreter& in, const Block& block);
/// G43, G43.1 … G49.
void tool_length(Interpreter& in, int code, const Block& block);

}  // namespace clsurf

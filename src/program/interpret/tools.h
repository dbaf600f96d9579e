#pragma once
// Tools: the one in the spindle, their lengths, lines of the tool table.

#include <cstddef>
#include <cstdint>

#include "core/geometry.h"
#include "program/interpret/tool_state.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Lines of the tool table: L1 gives a tool's values, L10 and L11 the offset with which the present
/// position reads as the words, in the active system or (L11) in G59.3 without G92.
void set_tool(Interpreter& in, int level, const Block& block);
/// The tool of the table; one that is not there has neither length nor diameter, and is reported.
[[nodiscard]] Tool tool_of(Interpreter& in, int number, std::size_t column);
/// T, M6, M61.
void change_tool(Interpreter& in, const Block& block);
/// From here on the end of the last motion is not what the position reads: a length was taken off, or
/// compensation ended beside the programmed point.
void part_from_machine(CompensationState& compensation, std::int64_t motions, const Vec3& by);
/// After a tool change, or after waiting for an input, the interpreter takes up the end of the last
/// motion again. The stand-alone one does so without the length that was taken off since: T1 M6 G43 in
/// one block leaves the position as it reads.
void read_machine_position(Interpreter& in, const Block& block);
/// G43, G43.1 … G49.
void tool_length(Interpreter& in, int code, const Block& block);

}  // namespace clsurf

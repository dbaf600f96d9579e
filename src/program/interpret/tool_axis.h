#pragma once
// Tool centre point control, and tool axes that are programmed as vectors.

#include <cmath>
#include <string>

#include "program/interpret/frames.h"
#include "program/interpret/modal_state.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// `text`: the words of the program.
void control_tool_centre_point(Interpreter& in, bool on, const std::string& text);
/// Returns whether the block gives a tool axis as a vector, in the axes of the program.
bool take_tool_axis(Interpreter& in, const Block& block);

/// Whether the tool axis is given as a vector, and the rotary axes are unknown.
[[nodiscard]] inline bool tool_axis_is_vector(const FiveAxisModes& modes, const ModalState& state) {
    return (modes.tool_centre_point || modes.tilted) && !std::isnan(state.tool_axis.x());
}

}  // namespace clsurf

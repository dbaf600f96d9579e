#pragma once
// M functions that DIN/ISO and Klartext have alike.

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// M91, M92: the positions of the block are those of the machine.
bool machine_position(Interpreter& in, int code, const Block& block);
/// M128, M129: positions are those of the tool's tip while rotary axes turn.
bool tool_centre_point(Interpreter& in, int code, const Block& block);

}  // namespace clsurf

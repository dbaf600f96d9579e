#pragma once
// Cutter compensation in the interpreter: its begin and end, forbidden codes, and the motions under it.

#include <cstddef>

#include "core/geometry.h"
#include "program/interpret/modal_state.h"
#include "program/interpret/tool_state.h"
#include "program/motion.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// G41 and G42 of RS274: with the tool in the spindle, or D.
void start_compensation(Interpreter& in, int code, const Block& block, std::size_t column);
/// G41 and G42 of the controls: Fanuc's D is a row of the table, the others take the tool in the spindle. Mirroring
/// swaps the sides.
void compensate_by_table(Interpreter& in, int code, const Block& block, std::size_t column);
void stop_compensation(Interpreter& in);
/// Fails at a code that the dialect forbids while compensation is on.
void refuse_in_compensation(const Interpreter& in, int code, const Block& block, std::size_t column);
/// The end of the motions: not as programmed under G41 and G42.
[[nodiscard]] Vec3 tool_position(const CompensationState& compensation, const ModalState& state);
void compensated_straight(Interpreter& in, MotionKind kind, const Vec3& end, const Vec3& rotary);
void compensated_arc(Interpreter& in, const Arc& arc, bool clockwise, const Vec3& end, const Vec3& rotary);

}  // namespace clsurf

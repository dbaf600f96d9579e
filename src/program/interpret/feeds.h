#pragma once
// What F counts, and the feed of a motion.

#include "program/interpret/dialect_rules.h"
#include "program/interpret/modal_state.h"

namespace clsurf {

class Interpreter;

/// Sets the unit of lengths [mm], and of feeds, unless F keeps its unit.
void count_in(ModalState& state, const MotionRules& rules, double unit);
/// F.
void take_feed(ModalState& state, const MotionRules& rules, double value);
/// G93, G94, G95.
void select_feed_mode(Interpreter& in, FeedMode mode);
/// The feed of a motion [mm/s]. `unit`: the unit in which F counts: mm of a length, or 1 for rotation in degrees, to
/// which inches do not apply.
[[nodiscard]] float feed_for(const ModalState& state, double length, double unit);
[[nodiscard]] inline float feed_for(const ModalState& state, double length) {
    return feed_for(state, length, state.feed_unit_mm);
}

}  // namespace clsurf

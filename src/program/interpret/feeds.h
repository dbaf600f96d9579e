#pragma once
// What F counts, and the feed of a motion.

#include "program/interpret/dialect_rules.h"
#include "program/interpret/modal_state.h"

namespace clsurf {

class Interpreter;

/// What lengths are counted in [mm], and feeds, if F does not keep its unit.
void count_in(ModalState& state, const MotionRules& rules, double unit);
/// F.
void take_feed(ModalState& state, const MotionRules& rules, double value);
/// G93, G94, G95.
void select_feed_mode(Interpreter& in, FeedMode mode);
/// Of a motion [mm/s]. `unit`: what F counts in, mm of a length, or 1 of a turn in degrees, where inches do not count.
[[nodiscard]] float feed_for(const ModalState& state, double length, double unit);
[[nodiscard]] inline float feed_for(const ModalState& state, double length) {
    return feed_for(state, length, state.feed_unit_mm);
}

}  // namespace clsurf

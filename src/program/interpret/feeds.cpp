#include "program/interpret/feeds.h"

#include "core/units.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {

void count_in(ModalState& state, const MotionRules& rules, double unit) {
    state.unit_mm = unit;
    if (!rules.feed_keeps_unit) state.feed_unit_mm = unit;
}

void take_feed(ModalState& state, const MotionRules& rules, double value) {
    state.feed = value;
    if (rules.feed_keeps_unit) state.feed_unit_mm = state.unit_mm;
}

void select_feed_mode(Interpreter& in, FeedMode mode) {
    if (mode == in.state_.feed_mode) return;
    in.state_.feed_mode = mode;
    const char* const code = mode == FeedMode::per_minute ? "G94" : mode == FeedMode::inverse_time ? "G93" : "G95";
    in.event("feed-mode", code, mode);
}

float feed_for(const ModalState& state, double length, double unit) {
    switch (state.feed_mode) {
        case FeedMode::inverse_time:
            // A motion of no length takes no time: any feed is valid except none.
            if (length > 0) return static_cast<float>(length * state.feed / seconds_per_minute);
            [[fallthrough]];
        case FeedMode::per_minute: return static_cast<float>(state.feed * unit / seconds_per_minute);
        case FeedMode::per_revolution:
            return static_cast<float>(state.feed * unit * state.spindle / seconds_per_minute);
    }
    return 0;
}

}  // namespace clsurf

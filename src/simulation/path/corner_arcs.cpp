#include "simulation/path/corner_arcs.h"

#include <algorithm>

#include "simulation/path/junction.h"
#include "simulation/path/transition_arc.h"

namespace clsurf {

/// What is left of the held block, and the arc to the next one.
void CornerArcs::add_corner(const PathElement& after) {
    const double tolerance = std::min(held_.tolerance, after.tolerance);
    TransitionArc arc;
    if (tolerance > 0) arc = transition_arc(held_, after, tolerance);
    const bool rounded = arc.kind == CornerKind::arc;
    const double end = held_.length - (rounded ? arc.arc_length_before : 0);
    if (end - used_ >= no_arc_length) ready_.push_back(used_ > 0 || rounded ? held_.part(used_, end) : held_);
    used_ = 0;
    if (!rounded) return;
    const PathElement whole = arc.element();
    const auto add_half = [&](const PathElement& block, double from, double to) {
        PathElement half = whole.part(from, to);
        half.take_block(block);
        half.deviation += arc.error;
        half.greatest_speed = std::min(half.greatest_speed, period_speed(arc.radius, arc.sweep, period_));
        ready_.push_back(half);
    };
    add_half(held_, 0, 0.5 * whole.length);
    add_half(after, 0.5 * whole.length, whole.length);
    used_ = arc.arc_length_after;
}

bool CornerArcs::next(PathElement& element) {
    while (ready_.empty()) {
        PathElement after;
        const bool more = source_->next(after);
        if (!holds_ && !more) return false;
        if (holds_ && more) add_corner(after);
        if (holds_ && !more) ready_.push_back(used_ > 0 ? held_.part(used_, held_.length) : held_);
        holds_ = more;
        if (more)
            held_ = after;
        else
            used_ = 0;
    }
    element = ready_.front();
    ready_.pop_front();
    return true;
}

}  // namespace clsurf

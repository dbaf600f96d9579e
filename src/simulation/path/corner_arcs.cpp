#include "simulation/path/corner_arcs.h"

#include <algorithm>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr int reached_places = 4;  ///< places of an arc within the reach of a step at which the curvature is evaluated

}  // namespace

/// A part of the held block; `beside`: the step that affects it.
void CornerArcs::add_piece(double from, double to, const Side* beside) {
    if (to - from < no_arc_length) return;
    PathElement piece = from > 0 || to < held_.length ? held_.part(from, to) : held_;
    if (beside != nullptr) {
        piece.jerk_share = ArcSteps::jerk_share;
        piece.greatest_speed = std::min(piece.greatest_speed, beside->speed);
    }
    ready_.push_back(piece);
}

/// The part of the held block that remains between the arcs at its ends.
void CornerArcs::add_block(double end, const Side& at_end) {
    const double left = std::max(end - used_, 0.0);
    const double reached = begun_.reach + at_end.reach;
    const double scale = reached > left ? left / reached : 1;
    const double first = used_ + scale * begun_.reach;
    const double last = reached > left ? first : end - at_end.reach;
    if (begun_.reach > 0) add_piece(used_, first, &begun_);
    add_piece(first, last, nullptr);
    if (at_end.reach > 0) add_piece(last, end, &at_end);
    passed_ += left;
}

/// The speed that the steps of an arc after the held block allow. Steps of previous arcs within the reach add up, and the
/// previous arc also gets the lower speed.
CornerArcs::Side CornerArcs::side_of(const TransitionArc& arc, const PathElement& whole, const PathElement& after) {
    const double end = held_.length - arc.arc_length_before;
    Side side;
    // The speed next to the arc is at most the speed on it, so the reach covers the required time.
    side.speed =
        std::min({steps_.speed(whole, held_.second_derivative(end), after.second_derivative(arc.arc_length_after)),
                  arc_speed(arc.radius, machine_->path.max_normal_acceleration),
                  std::max(held_.feed, after.feed) * machine_->controller.feed_override, machine_->path.max_speed});
    side.reach = steps_.reach(side.speed);
    const double at = passed_ + end - used_, reach = std::max(begun_.reach, side.reach);
    while (!recent_.empty() && recent_.front().at < at - reach) recent_.pop_front();
    if (recent_.empty()) return side;
    if (end - used_ > no_arc_length) recent_.push_back({at, Vec3::Zero()});
    Vec3 low = whole.second_derivative(0), high = low;
    const auto take = [&](const Vec3& bend) {
        low = low.cwiseMin(bend);
        high = high.cwiseMax(bend);
    };
    for (const Bend& bend : recent_) take(bend.value);
    for (int k = 1; k <= reached_places; ++k)
        take(whole.second_derivative(std::min(reach, whole.length) * k / reached_places));
    side.speed = std::min(side.speed, steps_.speed(high - low));
    if (begun_.speed > 0) ready_.back().greatest_speed = std::min(ready_.back().greatest_speed, side.speed);
    return side;
}

/// The rest of the held block, and the arc to the next one.
void CornerArcs::add_corner(const PathElement& after) {
    const double tolerance = std::min(held_.tolerance, after.tolerance);
    TransitionArc arc;
    if (tolerance > 0) arc = transition_arc(held_, after, tolerance);
    if (arc.kind != CornerKind::arc) {
        add_block(held_.length, {});
        used_ = 0;
        begun_ = {};
        return;
    }
    const PathElement whole = arc.element();
    Side side;
    if (steps_.count()) side = side_of(arc, whole, after);
    add_block(held_.length - arc.arc_length_before, side);
    const auto add_half = [&](const PathElement& block, double from, double to) {
        PathElement half = whole.part(from, to);
        half.take_block(block);
        half.deviation += arc.error;
        half.corner_arc = true;
        half.greatest_speed =
            std::min(half.greatest_speed, period_speed(arc.radius, arc.sweep, machine_->controller.period));
        if (steps_.count()) {
            half.jerk_share = ArcSteps::jerk_share;
            half.greatest_speed = std::min(half.greatest_speed, side.speed);
        }
        ready_.push_back(half);
    };
    add_half(held_, 0, 0.5 * whole.length);
    add_half(after, 0.5 * whole.length, whole.length);
    used_ = arc.arc_length_after;
    begun_ = side;
    if (!steps_.count()) return;
    recent_.push_back({passed_, whole.second_derivative(0)});
    const double last = std::min(whole.length, side.reach);
    for (int k = 0; k <= reached_places; ++k) {
        const double from_end = last * (reached_places - k) / reached_places;
        recent_.push_back({passed_ + whole.length - from_end, whole.second_derivative(whole.length - from_end)});
    }
    passed_ += whole.length;
}

bool CornerArcs::next(PathElement& element) {
    // The last element waits for the corner after it.
    while (ready_.size() < 2) {
        PathElement after;
        const bool more = source_->next(after);
        if (!holds_ && !more) break;
        if (holds_ && more) add_corner(after);
        if (holds_ && !more) {
            add_block(held_.length, {});
            used_ = 0;
            begun_ = {};
            recent_.clear();
        }
        holds_ = more;
        if (more) held_ = after;
    }
    if (ready_.empty()) return false;
    element = ready_.front();
    ready_.pop_front();
    return true;
}

}  // namespace clsurf

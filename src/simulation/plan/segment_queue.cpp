#include "simulation/plan/segment_queue.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/units.h"
#include "simulation/plan/blend_arc.h"

namespace clsurf {
namespace {

// sharp, segment_periods: docs/simulate.md#the-trapezoidal-planner, points 3 and 6.
constexpr double sharp = 2 * rad_per_deg;  ///< at a turn closer than this to a reversal the axes stop
constexpr double flat_corner = 1e-3;       ///< [rad] flatter corners are not limited by the tolerance
constexpr double segment_periods = 1.02;   ///< least duration of a segment at its highest speed [periods]
constexpr double no_overlap_left = 0.25;   ///< share of a segment after which its end is not changed any more
constexpr int settled_peaks = 4;           ///< ends at their limits before a backward scan stops

/// The speed in the middle of a segment that starts and ends at rest [mm/s].
double peak_speed(double acceleration, double length) { return std::sqrt(acceleration * length); }

double peak_of(const BlendSegment& segment) {
    // A later blend may take half of a length that is not final.
    return peak_speed(segment.tangential_acceleration(), segment.final_length ? segment.length : 0.5 * segment.length);
}

/// Direction of the acceleration at the start of a segment; for an arc including the normal acceleration.
Vec3 first_acceleration(const BlendSegment& segment) {
    if (!segment.curved()) return segment.path.direction;
    const PathElement& arc = segment.path;
    const double half = 0.5 * segment.feed;
    const Vec3 along = segment.acceleration() * arc.second;
    return (along - half * half / arc.radius * arc.first).normalized();
}

Vec3 last_acceleration(const BlendSegment& segment) {
    if (!segment.curved()) return segment.path.direction;
    const PathElement& arc = segment.path;
    const double angle = segment.sweep();
    return arc.second * std::cos(angle) - arc.first * std::sin(angle);
}

void release_step(BlendSegment& before, BlendSegment& after) {
    before.junction_speed = -1;
    before.step_after = 0;
    after.step_before = 0;
}

void set_end(BlendSegment& before, BlendSegment& after, SegmentEnd end) {
    before.end = end;
    after.blended_before = end == SegmentEnd::parabolic;
}

}  // namespace

OverlapSpeeds overlap_speeds(const BlendSegment& before, const BlendSegment& after, double speed_before,
                             double speed_after) {
    const double a1 = before.tangential_acceleration(), a2 = after.tangential_acceleration();
    const double v1 = std::min(peak_of(before), speed_before), v2 = std::min(peak_of(after), speed_after);
    const double longest = std::min(before.length / v1, after.length / v2);
    const double time = std::min(longest, std::max(v1 / a1, v2 / a2));
    OverlapSpeeds speeds{std::min(v1, time * a1), std::min(v2, time * a2), 0};
    const double theta = half_corner_angle(last_acceleration(before), first_acceleration(after));
    const double cosine = std::cos(theta);
    if (before.tolerance > 0 && cosine > std::sin(flat_corner)) {
        // With half of the acceleration for each half of the overlap, the deviation from the corner is the tolerance.
        const double limit = 2 * std::sqrt(a1 * before.tolerance / cosine);
        speeds.before = std::min(speeds.before, limit);
        speeds.after = std::min(speeds.after, limit);
    }
    speeds.along = std::sin(theta) * 0.5 * (speeds.before + speeds.after);
    return speeds;
}

double SegmentQueue::greatest_speed(const BlendSegment& segment) const {
    const double most = segment.overlapped ? 1.0 : machine_->controller.trapezoid.max_feed_override;
    return std::min({segment.feed * most, segment.max_speed, machine_->path.max_speed});
}

double SegmentQueue::target_speed(const BlendSegment& segment) const {
    double factor = segment.rapid ? 1.0 : machine_->controller.feed_override;
    if (segment.overlapped) factor = std::min(factor, 1.0);
    return std::min(segment.feed * factor, greatest_speed(segment));
}

double SegmentQueue::target_end_speed(const BlendSegment& segment, const BlendSegment* next) const {
    if (segment.end != SegmentEnd::tangent || next == nullptr) return 0;
    return std::min({segment.final_speed, target_speed(segment), target_speed(*next)});
}

/// Whether a direction step is small enough to be passed at speed, judged by the acceleration that it requires in one
/// period. Sets the permitted speed and the share of the acceleration that the step uses.
SegmentQueue::Junction SegmentQueue::join(BlendSegment& before, BlendSegment& after) const {
    const ControllerSettings& controller = machine_->controller;
    if (controller.lookahead_blocks < 2 || before.end == SegmentEnd::stop) return Junction::settled;
    const Vec3 in = before.end_tangent(), out = after.start_tangent();
    if ((in + out).norm() < sharp) {
        set_end(before, after, SegmentEnd::stop);
        return Junction::settled;
    }
    const double most = controller.trapezoid.max_feed_override;
    const double speed =
        std::min(std::min(before.feed * most, before.max_speed), std::min(after.feed * most, after.max_speed));
    const double step = speed / controller.period + after.max_acceleration;
    double share = 0;
    for (int i = 0; i < 3; ++i)
        share = std::max(
            share, step * std::abs(out[i] - in[i]) / machine_->axes[static_cast<std::size_t>(i)].max_acceleration);
    if (before.curved() || after.curved()) share /= 0.5;  // arcs use the other half
    const double allowed = std::clamp(controller.trapezoid.kink_ratio, 0.001, 0.7071);
    const bool tangent = share < allowed;
    before.junction_speed = tangent ? speed : speed * allowed / share;
    before.step_after = std::max(before.step_after, tangent ? share : allowed);
    after.step_before = std::max(after.step_before, tangent ? share : allowed);
    if (!tangent) return Junction::open;
    set_end(before, after, SegmentEnd::tangent);
    return Junction::settled;
}

/// How the last segment passes into a new one: the fastest at the corner of an overlap, a slow tangent passage and an arc.
void SegmentQueue::blend(BlendSegment& after) {
    BlendSegment& before = segments_.back();
    if (before.progress > 0.5 * before.length || join(before, after) == Junction::settled) return;
    if (before.end != SegmentEnd::parabolic) return;
    const std::optional<BlendedCorner> arc = blend_corner(before, after, *machine_);
    // Both blocks of an overlap have only half of the acceleration, which also slows the adjacent corners.
    const double overlap = 0.5 * overlap_speeds(before, after, greatest_speed(before), greatest_speed(after)).along;
    const double tangent = before.junction_speed;
    const double of_arc = arc ? arc->arc.max_speed : 0;
    if (overlap >= tangent && overlap >= of_arc) {
        release_step(before, after);
        set_end(before, after, SegmentEnd::parabolic);
    } else if (tangent >= of_arc) {
        set_end(before, after, SegmentEnd::tangent);
    } else {
        release_step(before, after);
        before.path = arc->before.path;
        before.length = arc->before.length;
        after.path = arc->after.path;
        after.length = arc->after.length;
        set_end(before, after, SegmentEnd::tangent);
        if (arc->consumed) {
            before = arc->arc;
        } else {
            before.finish_length(machine_->controller.period);
            segments_.push_back(arc->arc);
        }
    }
}

void SegmentQueue::add(const PathElement& element) {
    BlendSegment segment = segment_of(element, *machine_);
    if (!segments_.empty()) {
        BlendSegment& before = segments_.back();
        if (before.rapid != segment.rapid) set_end(before, segment, SegmentEnd::stop);
        if (machine_->controller.trapezoid.arc_blends) blend(segment);
        segments_.back().finish_length(machine_->controller.period);
    }
    segments_.push_back(segment);
    scan_back();
}

/// The speed at the end of a segment from which the next segment can brake.
void SegmentQueue::limit_end(BlendSegment& before, BlendSegment& segment) const {
    const double acceleration = segment.tangential_acceleration();
    const bool junction = before.junction_speed >= 0 && before.end == SegmentEnd::tangent;
    if (!segment.final_length) {
        const double peak = std::min(peak_speed(acceleration, segment.length), greatest_speed(segment));
        before.final_speed = std::min(before.max_speed, peak);
        if (junction) before.final_speed = std::min(before.final_speed, before.junction_speed);
        segment.final_speed = 0;
        return;
    }
    const double reached = std::sqrt(segment.final_speed * segment.final_speed + 2 * acceleration * segment.length);
    double limit = std::min(segment.max_speed, before.max_speed);
    if (junction) limit = std::min(limit, before.junction_speed);
    if (reached >= limit) before.at_limit = true;  // more look-ahead only raises the reachable speed
    before.final_speed = std::min(reached, limit);
    segment.limit_speed_by_length(segment_periods * machine_->controller.period);
}

/// Scans backward over the look-ahead, until the known blocks can no longer raise a speed.
void SegmentQueue::scan_back() {
    bool passed_rest = false;
    int peaks = 0;
    const auto depth = static_cast<std::size_t>(machine_->controller.lookahead_blocks) + 1;
    for (std::size_t x = 1; x <= depth && x < segments_.size(); ++x) {
        BlendSegment& segment = segments_[segments_.size() - x];
        BlendSegment& before = segments_[segments_.size() - x - 1];
        if (before.end != SegmentEnd::tangent) {
            if (std::exchange(passed_rest, true)) return;
            continue;
        }
        if (before.progress >= no_overlap_left * before.length || before.ends_now || before.blending_next) return;
        limit_end(before, segment);
        if (segment.at_limit && ++peaks > settled_peaks) return;
    }
}

}  // namespace clsurf

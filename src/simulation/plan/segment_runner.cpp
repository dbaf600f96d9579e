#include "simulation/plan/segment_runner.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr double no_speed = 1e-8;      ///< [mm/s]
constexpr double no_distance = 1e-12;  ///< [mm]
constexpr double no_time = 1e-12;      ///< [s]

/// Distance of a point from a nearby segment [mm]. A line needs one step, an arc fewer than four if the point is within a
/// few periods of its progress.
double distance_to(const BlendSegment& segment, const Vec3& point) {
    constexpr int most_steps = 4;
    double at = segment.progress;
    for (int i = 0; i < most_steps; ++i) {
        const Vec3 tangent =
            at < segment.lead ? segment.lead_tangent : segment.path.tangent(at - segment.lead).normalized();
        at = std::clamp(at + tangent.dot(point - segment.at(at)), 0.0, segment.length);
    }
    return (point - segment.at(at)).norm();
}

}  // namespace

SegmentRunner::SegmentRunner(SegmentQueue& queue, const Machine& machine, const Vec3& position)
    : queue_(&queue), machine_(&machine), period_(machine.controller.period), position_(position) {}

/// A short segment between others that are passed at speed has one constant acceleration.
void SegmentRunner::activate(BlendSegment& segment) const {
    if (segment.active) return;
    segment.active = true;
    const double mean = 0.5 * (segment.speed + std::min(segment.final_speed, queue_->target_speed(segment)));
    segment.ramp = !segment.rapid && segment.end == SegmentEnd::tangent && segment.to_go() > 0 &&
                   segment.to_go() * machine_->controller.trapezoid.ramp_frequency < mean;
    segment.blending_next = segment.braking = false;
}

/// With the speed w after a period T and the distance s left before the period, s = ½ (v + w) T + (w² − u²)/(2 a) brakes to
/// u at the end: w = −½ a T + √(u² + a (2 s − v T) + (½ a T)²).
SegmentRunner::Step SegmentRunner::trapezoid(const BlendSegment& segment, const BlendSegment* next) const {
    const double a = segment.tangential_acceleration();
    const double end = queue_->target_end_speed(segment, next);
    const double half = 0.5 * a * segment.cycle;
    const double rest = end * end + a * (2 * segment.to_go() - segment.speed * segment.cycle);
    const double highest = rest > 0 ? std::sqrt(rest + half * half) - half : -half;
    const double wanted = std::min(highest, queue_->target_speed(segment));
    return {std::clamp((wanted - segment.speed) / std::max(segment.cycle, no_time), -a, a), highest};
}

/// Constant acceleration to the speed at the end. False: the segment ends at rest.
bool SegmentRunner::ramp(const BlendSegment& segment, const BlendSegment* next, Step& step) const {
    const double end = queue_->target_end_speed(segment, next);
    if (end < no_speed) return false;
    constexpr double shortest = 1e-16;
    const double time = std::max(shortest, segment.to_go() / (0.5 * (segment.speed + end)));
    const double a = segment.tangential_acceleration();
    step = {std::clamp((end - segment.speed) / time, -a, a), end};
    return true;
}

/// Runs a segment for its cycle and moves the position by the distance covered.
void SegmentRunner::update(BlendSegment& segment, const BlendSegment* next) {
    const Vec3 before = segment.at(segment.progress);
    if (!segment.blending_next) segment.speed_at_blend = segment.speed;
    Step step;
    const bool ramps = segment.ramp && segment.end == SegmentEnd::tangent && ramp(segment, next, step);
    if (!ramps) step = trapezoid(segment, next);
    double speed = segment.speed + step.acceleration * segment.cycle;
    if (speed < 0) {
        speed = 0;
        if (segment.to_go() < segment.speed * segment.cycle) segment.progress = segment.length;
    } else {
        segment.progress += 0.5 * (speed + segment.speed) * segment.cycle;
        segment.progress = std::clamp(segment.progress, 0.0, segment.length);
    }
    segment.speed = speed;
    segment.braking = std::abs(step.speed - speed) < no_speed && step.acceleration < 0;
    look_for_end(segment, next);
    position_ += segment.at(segment.progress) - before;
}

/// Finds whether the segment ends within the next period, when, and at what speed.
void SegmentRunner::look_for_end(BlendSegment& segment, const BlendSegment* next) const {
    segment.cycle = period_;
    const bool rests = segment.end == SegmentEnd::stop || segment.end == SegmentEnd::exact;
    const double left = segment.to_go();
    const auto end_after = [&](double time, double speed) {
        segment.ends_now = true;
        segment.cycle = time;
        segment.end_speed = speed;
    };
    if (left <= no_distance) {
        segment.progress = segment.length;
        end_after(0, segment.speed);
        if (rests) segment.done = true;
        return;
    }
    if (rests) return;
    double end = queue_->target_end_speed(segment, next);
    const double mean = 0.5 * (segment.speed + end);
    if (!(mean > no_speed)) return;
    double time = left / mean;
    const double a = segment.tangential_acceleration();
    const double asked = (end - segment.speed) / time;
    if (std::abs(asked) > a) {
        // The end is reached at another speed than requested: s = v t ± ½ a t².
        const double signed_a = std::copysign(a, asked);
        const double square = segment.speed * segment.speed + 2 * signed_a * left;
        if (square < 0) return;
        time = (std::sqrt(square) - segment.speed) / signed_a;
        end = segment.speed + signed_a * time;
    }
    if (time < no_time) {
        segment.progress = segment.length;
        end_after(0, end);
    } else if (time < period_) {
        end_after(time, end);
    }
}

/// Runs the last part of a segment, and the rest of the period on the next one.
void SegmentRunner::finish(BlendSegment& segment, BlendSegment* next) {
    position_ += segment.at(segment.length) - segment.at(segment.progress);
    segment.progress = segment.length;
    segment.done = true;
    if (next == nullptr) return;
    if (segment.end == SegmentEnd::tangent) {
        next->cycle = period_ - segment.cycle;
        next->speed = segment.end_speed;
    }
    update(*next, queue_->size() > 2 ? &(*queue_)[2] : nullptr);
}

/// Runs a segment for a whole period, and the next one if they overlap.
void SegmentRunner::run_whole(BlendSegment& segment, BlendSegment* next) {
    segment.cycle = period_;
    update(segment, next);
    if (next == nullptr) return;
    const OverlapSpeeds speeds =
        overlap_speeds(segment, *next, queue_->target_speed(segment), queue_->target_speed(*next));
    segment.blend_speed = speeds.before;
    next->blend_speed = speeds.after;
    const bool begins = segment.end == SegmentEnd::parabolic && segment.braking && segment.speed < segment.blend_speed;
    segment.blending_next = segment.blending_next || begins;
    if (!segment.blending_next) return;
    next->overlapped = true;
    update(*next, nullptr);
    overlap_speed_ = next->speed;
}

LimitingFactor SegmentRunner::limiting_of(const BlendSegment& segment) const {
    if (segment.speed < no_speed) return LimitingFactor::none;
    constexpr double same = 1 - 1e-6;
    const double target = queue_->target_speed(segment);
    if (segment.speed < target * same) {
        const bool to_rest = segment.braking && !(segment.end == SegmentEnd::tangent);
        return to_rest ? LimitingFactor::lookahead_end : LimitingFactor::axis_acceleration;
    }
    const double factor = segment.rapid ? 1 : machine_->controller.feed_override;
    if (target >= segment.feed * std::min(factor, 1.0) * same)
        return segment.rapid ? LimitingFactor::axis_speed
               : factor != 1 ? LimitingFactor::feed_override
                             : LimitingFactor::feed;
    if (target * period_ * 1.05 >= segment.length) return LimitingFactor::block_time;
    return segment.curved() ? LimitingFactor::axis_acceleration : LimitingFactor::axis_speed;
}

/// Distance between a point of an arc between blocks and the nearer block.
double SegmentRunner::deviation_of(const BlendSegment& segment) const {
    if (!segment.blend) return segment.path.deviation;
    const double angle = (segment.progress - segment.lead) * segment.path.rate;
    const double nearer = std::clamp(angle, 0.0, std::max(0.0, segment.sweep() - angle));
    return segment.path.deviation + segment.path.radius * (1 - std::cos(nearer));
}

/// Distance of the point from the programmed path: if two blocks overlap, from the nearer one.
void SegmentRunner::measure(const BlendSegment& segment, const BlendSegment* next, const BlendSegment& shown,
                            PlannedPoint& point) const {
    const bool overlap =
        next != nullptr && segment.end == SegmentEnd::parabolic && segment.to_go() > 0 && next->progress > 0;
    point.tolerated = (overlap ? segment : shown).tolerance > 0 || shown.end == SegmentEnd::exact;
    point.deviation = deviation_of(shown);
    if (overlap) point.deviation += std::min(distance_to(segment, position_), distance_to(*next, position_));
}

/// The reported segment: the faster one of two that overlap. If the segment ends within the period, the next one, unless
/// a tangent end leaves it the shorter part of the period.
const BlendSegment& SegmentRunner::reported(const BlendSegment& segment, const BlendSegment* next, bool ended) const {
    if (next == nullptr) return segment;
    if (!ended) return segment.blending_next && segment.speed <= next->speed ? *next : segment;
    return segment.end == SegmentEnd::tangent && segment.cycle > next->cycle ? segment : *next;
}

bool SegmentRunner::run(PlannedPoint& point) {
    if (queue_->empty()) return false;
    BlendSegment& segment = (*queue_)[0];
    BlendSegment* next = queue_->size() > 1 ? &(*queue_)[1] : nullptr;
    activate(segment);
    segment.overlapped = false;
    if (next != nullptr) next->overlapped = false;
    overlap_speed_ = 0;
    const bool ends = segment.ends_now;
    if (!segment.done) {
        if (ends)
            finish(segment, next);
        else
            run_whole(segment, next);
    }
    const BlendSegment& last = ends && next != nullptr ? *next : segment;
    point.position = position_;
    point.speed = last.speed + (ends ? 0 : overlap_speed_);
    const BlendSegment& shown = reported(segment, next, ends);
    point.line = shown.path.line;
    point.limiting = limiting_of(shown);
    measure(segment, next, shown, point);
    if (segment.done) queue_->pop_front();
    return true;
}

}  // namespace clsurf

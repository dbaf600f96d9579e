#include "simulation/path/path_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

// Both shares: docs/simulate.md#2-corner-rounding.
constexpr double share_of_bends = 0.25;  ///< share of the tolerance for jumps of curvature if the path has arcs
constexpr double top_share = 0.25;       ///< share of a rounding's width if only the path limits the jerk

}  // namespace

std::string_view name_of(LimitingFactor limiting) {
    constexpr std::array<std::string_view, 10> names{
        "at rest",          "feed",        "axis speed",     "axis acceleration", "jerk",
        "corner tolerance", "chord error", "look-ahead end", "override",          "block time"};
    return names[static_cast<std::size_t>(limiting)];
}

Vec3 Span::at(double tau, double& deviation, double& pace) const {
    deviation = base.deviation;
    pace = 1;
    const bool spiral = base.arc && base.growth != 0;  // its position depends on the angle, not on the length
    if (!rounded && !spiral) return base.at(from + tau);
    Vec3 tangent;
    const Vec3 position = base.at(from + tau, tangent);
    if (!rounded) {
        pace = tangent.norm();
        return position;
    }
    const std::array<Vec3, 5>& c = rounding;
    const Vec3 added = c[0] + tau * (c[1] + tau * (c[2] + tau * (c[3] + tau * c[4])));
    deviation += added.norm();
    pace = (tangent + c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]))).norm();
    return position + added;
}

PathStream::PathStream(MotionSource& source, const Machine& machine, const Vec3& start)
    : machine_(&machine), blocks_(source, machine, start), source_(&blocks_) {
    const bool arcs = drives_arcs(machine);
    const bool curves = machine.controller.curve != CurveMode::none;
    // Only machines without a jerk limit of the axes permit every jump of curvature.
    if ((!arcs || !only_path_jerk(machine)) && (curves || source.outline().curved)) bend_share_ = share_of_bends;
    if (limits_jerk_in_bends(machine) && !jerks_freely(machine)) top_ = top_share;
    if (machine.controller.merging_tolerance.value_or(0) > 0) {
        merged_ = std::make_unique<BlockMerging>(*source_);
        source_ = merged_.get();
    }
    if (curves) {
        curves_ = std::make_unique<CurveBlocks>(*source_, machine.controller.curve);
        source_ = curves_.get();
    }
    if (arcs) {
        arcs_ = std::make_unique<CornerArcs>(*source_, machine);
        source_ = arcs_.get();
    }
}

void PathStream::add_joint(const PathElement& before, const PathElement& after) {
    Joint joint;
    joint.at = ends_.back();
    joint.turn = after.tangent(0) - before.tangent(before.length);
    joint.turning = joint.turn.norm();
    const bool splines = before.spline && after.spline;
    if (joint.turning < (splines ? straight_on_of_splines : straight_on)) joint.turn.setZero(), joint.turning = 0;
    joint.tolerance = std::min(before.tolerance, after.tolerance);
    // A corner without an arc stays clear of other corners' arcs, which use the whole tolerance.
    joint.widest = arcs_ ? std::min(before.length, after.length) : std::numeric_limits<double>::infinity();
    if (bend_share_ > 0 && !before.corner_arc && !after.corner_arc)
        joint.bend = after.second_derivative(0) - before.second_derivative(before.length);
    const double bend = joint.bend.norm();
    if (bend > (splines ? least_bend_jump_of_splines : least_bend_jump)) {
        // |d (v − |d|)³/(12 v²)| is greatest at v/4: 27/3072 v². Each rounding uses at most half a block, so that those at
        // its two ends do not overlap.
        const double widest = std::sqrt(bend_share_ * joint.tolerance * 3072 / (27 * bend));
        joint.bend_width = std::min({widest, 0.5 * before.length, 0.5 * after.length});
    } else {
        joint.bend.setZero();
    }
    joints_.push_back(joint);
}

bool PathStream::begin_section() {
    elements_.clear();
    ends_.clear();
    joints_.clear();
    ready_.clear();
    front_taken_ = false;
    first_element_ = first_joint_ = element_count_ = 0;
    widths_done_ = deviations_done_ = scales_done_ = spans_done_ = 0;
    closed_ = false;
    if (!blocks_.begin_section()) return false;
    PathElement element;
    if (source_->next(element)) {
        elements_.push_back(element);
        ends_.push_back(element.length);
        element_count_ = 1;
    } else {
        closed_ = true;
    }
    return true;
}

/// Reads one more element of the section; false: the section is complete.
bool PathStream::pull() {
    if (closed_) return false;
    PathElement element;
    if (!source_->next(element)) {
        closed_ = true;
        closed_at_ = ends_.back();
        return false;
    }
    add_joint(elements_.back(), element);
    elements_.push_back(element);
    ends_.push_back(ends_.back() + element.length);
    ++element_count_;
    return true;
}

/// The widest rounding of a joint: with equal widths of all roundings that it overlaps, its own deviation stays within the
/// tolerance. It stays inside the section and reaches over at most reach_of_a_joint neighbours.
void PathStream::settle_width(std::int64_t i) {
    Joint& j = joint(i);
    if (j.turning == 0) return;
    const std::int64_t last = element_count_ - 2;
    const double allowed = (1 - bend_share_) * j.tolerance;
    double widest = std::min({j.at, j.widest, 6 * allowed / j.turning * (1 + top_) / (1 + top_ * (1 + top_))});
    if (closed_) widest = std::min(widest, closed_at_ - j.at);
    if (i - reach_of_a_joint >= 0) widest = std::min(widest, j.at - joint(i - reach_of_a_joint).at);
    if (i + reach_of_a_joint <= last) widest = std::min(widest, joint(i + reach_of_a_joint).at - j.at);
    const std::int64_t low = std::max(first_joint_, i - reach_of_a_joint), high = std::min(last, i + reach_of_a_joint);
    // It ends before an exact path begins: scaling by the tolerance there would reduce its width to 0.
    for (std::int64_t n = low; n <= high; ++n) {
        if (joint(n).tolerance == 0) widest = std::min(widest, std::abs(joint(n).at - j.at));
    }
    if (!(widest > 0)) return;
    // Σ |Δt| (w − |d|)³/(6 w²) is convex in w: from above, Newton's method converges to the root from any start.
    double width = widest;
    if (i > low && joint(i - 1).width > 0) width = std::min(widest, joint(i - 1).width);
    constexpr int most_steps = 60;
    constexpr double near = 1e-7;
    for (int k = 0; k < most_steps; ++k) {
        double cubes = 0, slopes = 0;
        const auto add = [&](const Joint& other, double distance) {
            const double left = width - distance;
            if (left <= 0) return false;
            cubes += other.turning * left * left * left;
            slopes += other.turning * left * left * (width + 2 * distance);
            const double inner = top_ * width - distance;
            if (inner <= 0) return true;
            cubes -= other.turning * inner * inner * inner;
            slopes -= other.turning * inner * inner * (top_ * width + 2 * distance);
            return true;
        };
        for (std::int64_t n = i; n >= low && add(joint(n), j.at - joint(n).at); --n) {}
        for (std::int64_t n = i + 1; n <= high && add(joint(n), joint(n).at - j.at); ++n) {}
        const double scale = 1 / (6 * width * width * (1 - top_ * top_));
        const double next = std::min(widest, width - width * (cubes * scale - allowed) / (slopes * scale));
        const bool found = std::abs(next - width) <= near * width;
        width = next;
        if (found) break;
    }
    j.width = width;
    j.share = j.turning / (6 * width * width * (1 - top_ * top_));
}

/// The deviation at a joint if every rounding has its greatest width.
void PathStream::settle_deviation(std::int64_t i) {
    Joint& j = joint(i);
    const std::int64_t high = std::min(element_count_ - 2, i + reach_of_a_joint);
    for (std::int64_t k = std::max(first_joint_, i - reach_of_a_joint); k <= high; ++k) {
        const Joint& other = joint(k);
        const double distance = std::abs(other.at - j.at);
        const double left = other.width - distance, inner = top_ * other.width - distance;
        if (left > 0) j.deviation += other.share * left * left * left;
        if (inner > 0) j.deviation -= other.share * inner * inner * inner;
    }
}

/// Scales the width down to satisfy the tolerances of all joints that it reaches.
void PathStream::settle_scale(std::int64_t i) {
    Joint& j = joint(i);
    double scale = 1;
    const std::int64_t high = std::min(element_count_ - 2, i + reach_of_a_joint);
    for (std::int64_t k = std::max(first_joint_, i - reach_of_a_joint); k <= high; ++k) {
        const Joint& other = joint(k);
        const double allowed = (1 - bend_share_) * other.tolerance;
        if (other.deviation > allowed && std::abs(other.at - j.at) < j.width)
            scale = std::min(scale, allowed / other.deviation);
    }
    j.width *= scale;
    if (j.width > 0) j.turn_share = j.turn / (6 * j.width * j.width * (1 - top_ * top_));
    if (j.bend_width > 0) j.bend_share = j.bend / (12 * j.bend_width * j.bend_width);
    j.reach = std::max(j.width, j.bend_width);
}

/// Advances every stage as far as the known elements allow.
void PathStream::settle() {
    const std::int64_t joints = element_count_ - 1;
    const auto known = [&](std::int64_t done_before) {
        return closed_ ? joints : std::max<std::int64_t>(0, done_before - reach_of_a_joint);
    };
    while (widths_done_ < known(joints)) settle_width(widths_done_++);
    while (deviations_done_ < known(widths_done_)) settle_deviation(deviations_done_++);
    while (scales_done_ < known(deviations_done_)) settle_scale(scales_done_++);
}

const Span* PathStream::next() {
    if (std::exchange(front_taken_, false)) ready_.pop_front();
    while (ready_.empty()) {
        if (element_count_ == 0) return nullptr;
        const std::int64_t joints = element_count_ - 1;
        // The spans of an element need all roundings that can reach into it.
        const bool can = closed_ ? spans_done_ < element_count_ : scales_done_ > spans_done_ + reach_of_a_joint + 1;
        if (can) {
            make_spans(spans_done_++);
            // Removes joints that no later element can need.
            while (first_joint_ < std::min(joints, spans_done_ - 3 * reach_of_a_joint - 2)) {
                joints_.pop_front();
                ++first_joint_;
            }
            while (first_element_ < std::min(spans_done_, element_count_ - 1)) {
                elements_.pop_front();
                ends_.pop_front();
                ++first_element_;
            }
            continue;
        }
        if (closed_) return nullptr;
        for (std::int64_t i = 0; i < reach_of_a_joint && pull(); ++i) {}
        settle();
    }
    front_taken_ = true;
    return &ready_.front();
}

}  // namespace clsurf

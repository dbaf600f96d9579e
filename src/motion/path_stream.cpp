#include "motion/path_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>


namespace clsurf {
namespace {

constexpr double share_of_bends = 0.25;  ///< of the tolerance, for jumps of curvature, where there are arcs

/// (w − |d|)³/(6 w²) where |d| < w.
double rounding_at(double distance, double width) {
    const double left = width - std::abs(distance);
    return left > 0 ? left * left * left / (6 * width * width) : 0.0;
}

}  // namespace

std::string_view name_of(Ruling ruling) {
    constexpr std::array<std::string_view, 10> names{"at rest", "feed", "axis speed", "axis acceleration", "jerk", "corner tolerance", "chord error", "look-ahead end", "override", "block time"};
    return names[static_cast<std::size_t>(ruling)];
}

Vec3 Span::at(double tau, double& deviation, double& pace) const {
    deviation = base.deviation;
    pace = 1;
    if (!rounded) return base.at(from + tau);
    Vec3 tangent;
    const Vec3 position = base.at(from + tau, tangent);
    const std::array<Vec3, 5>& c = rounding;
    const Vec3 added = c[0] + tau * (c[1] + tau * (c[2] + tau * (c[3] + tau * c[4])));
    deviation += added.norm();
    pace = (tangent + c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]))).norm();
    return position + added;
}

PathStream::PathStream(const Program& program, const Machine& machine, const Vec3& start)
    : machine_(&machine), blocks_(program, machine, start), source_(&blocks_) {
    // Only drives that bear any jerk bear the jumps of curvature at the ends of arcs.
    const bool arcs = machine.controller.corner == CornerMode::arc &&
                      std::none_of(machine.axes.begin(), machine.axes.end(), [](const MachineAxis& axis) { return axis.max_jerk > 0; });
    const bool curves = machine.controller.curve != CurveMode::none;
    if (!arcs && (curves || !program.motions.arcs.empty())) bend_share_ = share_of_bends;
    if (curves) {
        curves_ = std::make_unique<CurveBlocks>(*source_, machine.controller.curve);
        source_ = curves_.get();
    }
    if (arcs) {
        arcs_ = std::make_unique<CornerArcs>(*source_, machine.controller.period);
        source_ = arcs_.get();
    }
}

void PathStream::add_joint(const PathElement& before, const PathElement& after) {
    Joint joint;
    joint.at = ends_.back();
    joint.turn = after.tangent(0) - before.tangent(before.length);
    joint.turning = joint.turn.norm();
    if (joint.turning < straight_on) joint.turn.setZero(), joint.turning = 0;
    joint.tolerance = std::min(before.tolerance, after.tolerance);
    // A corner that has no arc keeps off the arcs of others, which take the tolerance for themselves.
    joint.widest = arcs_ ? std::min(before.length, after.length) : std::numeric_limits<double>::infinity();
    if (bend_share_ > 0) joint.bend = after.second_derivative(0) - before.second_derivative(before.length);
    const double bend = joint.bend.norm();
    if (bend > least_bend_jump) {
        // |d (v − |d|)³/(12 v²)| is greatest at v/4: 27/3072 v². The halves of a block keep the
        // roundings of its two ends apart.
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

/// Takes one more element into the section; false: the section is closed.
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

/// The widest rounding of a joint: its own deviation, with equal widths of those that it overlaps,
/// within the tolerance; inside the section; over no more than reach_of_a_joint neighbours.
void PathStream::settle_width(std::int64_t i) {
    Joint& j = joint(i);
    if (j.turning == 0) return;
    const std::int64_t last = element_count_ - 2;
    double widest = std::min(j.at, j.widest);
    if (closed_) widest = std::min(widest, closed_at_ - j.at);
    if (i - reach_of_a_joint >= 0) widest = std::min(widest, j.at - joint(i - reach_of_a_joint).at);
    if (i + reach_of_a_joint <= last) widest = std::min(widest, joint(i + reach_of_a_joint).at - j.at);
    const double allowed = (1 - bend_share_) * j.tolerance;
    const auto deviation = [&](double width) {
        double sum = 0;
        for (std::int64_t k = i; k >= std::max<std::int64_t>(first_joint_, i - reach_of_a_joint) && j.at - joint(k).at < width; --k) {
            sum += joint(k).turning * rounding_at(j.at - joint(k).at, width);
        }
        for (std::int64_t k = i + 1; k <= std::min(last, i + reach_of_a_joint) && joint(k).at - j.at < width; ++k) {
            sum += joint(k).turning * rounding_at(joint(k).at - j.at, width);
        }
        return sum;
    };
    double high = std::min(widest, 6 * allowed / j.turning);
    if (deviation(high) > allowed) {
        double low = 0;
        constexpr int halvings = 12;  // the scale of settle() makes up for what is left
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (low + high);
            (deviation(middle) > allowed ? high : low) = middle;
        }
        high = low > 0 ? low : high;
    }
    j.width = high;
}

/// Takes every stage as far as the elements known allow.
void PathStream::settle() {
    const std::int64_t joints = element_count_ - 1;
    const auto known = [&](std::int64_t done_before) { return closed_ ? joints : std::max<std::int64_t>(0, done_before - reach_of_a_joint); };
    while (widths_done_ < known(joints)) settle_width(widths_done_++);
    for (; deviations_done_ < (closed_ ? joints : std::max<std::int64_t>(0, widths_done_ - reach_of_a_joint)); ++deviations_done_) {
        Joint& j = joint(deviations_done_);
        const std::int64_t low = std::max(first_joint_, deviations_done_ - reach_of_a_joint);
        const std::int64_t high = std::min(joints - 1, deviations_done_ + reach_of_a_joint);
        for (std::int64_t k = low; k <= high; ++k) j.deviation += joint(k).turning * rounding_at(joint(k).at - j.at, joint(k).width > 0 ? joint(k).width : 1e-300);
    }
    for (; scales_done_ < (closed_ ? joints : std::max<std::int64_t>(0, deviations_done_ - reach_of_a_joint)); ++scales_done_) {
        Joint& j = joint(scales_done_);
        const std::int64_t low = std::max(first_joint_, scales_done_ - reach_of_a_joint);
        const std::int64_t high = std::min(joints - 1, scales_done_ + reach_of_a_joint);
        for (std::int64_t k = low; k <= high; ++k) {
            const Joint& other = joint(k);
            const double allowed = (1 - bend_share_) * other.tolerance;
            if (std::abs(other.at - j.at) < j.width && other.deviation > allowed) j.scale = std::min(j.scale, allowed / other.deviation);
        }
    }
}

bool PathStream::next(Span& span) {
    while (ready_.empty()) {
        if (element_count_ == 0) return false;
        const std::int64_t joints = element_count_ - 1;
        // An element's spans need the roundings that can reach into it.
        const bool can = closed_ ? spans_done_ < element_count_ : scales_done_ > spans_done_ + reach_of_a_joint + 1;
        if (can) {
            make_spans(spans_done_++);
            // What no later element can need any more.
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
        if (closed_) return false;
        for (std::int64_t i = 0; i < reach_of_a_joint && pull(); ++i) {}
        settle();
    }
    span = ready_.front();
    ready_.pop_front();
    return true;
}

}  // namespace clsurf

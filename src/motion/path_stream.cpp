#include "motion/path_stream.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "motion/junction.h"

namespace clsurf {
namespace {

constexpr double straight_on = 1e-9;          ///< [rad] turning below this moves no axis
constexpr double reversal = 179.0 * std::numbers::pi / 180;
constexpr double arc_share = 0.25;  ///< of the tolerance, for jumps of curvature, in programs with arcs
constexpr double least_bend_jump = 1e-9;      ///< [1/mm]
constexpr double infinite = std::numeric_limits<double>::infinity();

/// (w − |d|)³/(6 w²) where |d| < w.
double rounding_at(double distance, double width) {
    const double left = width - std::abs(distance);
    return left > 0 ? left * left * left / (6 * width * width) : 0.0;
}

double path_tolerance(const ProgramEvent& event, const Machine& machine) {
    const std::string& text = event.value;
    if (machine.controller.corner == CornerMode::stop || text.starts_with("G61") || text.starts_with("G60")) return 0;
    const std::size_t p = text.find('P');
    if (p != std::string::npos) {
        double value = 0;
        const char* first = text.data() + p + 1;
        while (first < text.data() + text.size() && (*first == ' ' || *first == '=')) ++first;
        const auto read = std::from_chars(first, text.data() + text.size(), value);
        if (read.ec == std::errc() && value > 0) return value;
    }
    return machine.controller.tolerance;
}

}  // namespace

std::string_view name_of(Ruling ruling) {
    constexpr std::array<std::string_view, 10> names{"at rest", "feed", "axis speed", "axis acceleration", "jerk", "corner tolerance", "chord error", "look-ahead end", "override", "block time"};
    return names[static_cast<std::size_t>(ruling)];
}

Vec3 Span::at(double tau, double& deviation, double& pace) const {
    const Vec3 position = base.at(from + tau);
    if (!rounded) {
        deviation = 0;
        pace = 1;
        return position;
    }
    const std::array<Vec3, 5>& c = rounding;
    const Vec3 added = c[0] + tau * (c[1] + tau * (c[2] + tau * (c[3] + tau * c[4])));
    deviation = added.norm();
    pace = (base.tangent(from + tau) + c[1] + tau * (2 * c[2] + tau * (3 * c[3] + tau * 4 * c[4]))).norm();
    return position + added;
}

PathStream::PathStream(const Program& program, const Machine& machine, const Vec3& start)
    : program_(&program), machine_(&machine), has_arcs_(!program.motions.arcs.empty()), at_(start) {
    tolerance_ = machine.controller.corner == CornerMode::stop ? 0 : machine.controller.tolerance;
    // Where the program itself says where it begins, the axes stand there.
    const Xyz& known = program.motions.start;
    if (known.x == known.x) at_.x() = known.x;
    if (known.y == known.y) at_.y() = known.y;
    if (known.z == known.z) at_.z() = known.z;
}

void PathStream::follow_events(std::int64_t motion) {
    const std::vector<ProgramEvent>& events = program_->events;
    for (; next_event_ < events.size() && events[next_event_].motion <= motion; ++next_event_) {
        if (events[next_event_].name == "path-mode") tolerance_ = path_tolerance(events[next_event_], *machine_);
    }
}

/// The next motion with a way; dwells on the way to it are added up.
bool PathStream::next_element(PathElement& element) {
    const Motions& motions = program_->motions;
    const auto fail = [&](std::int64_t m, const std::string& what) {
        const auto line = motions.line[static_cast<std::size_t>(m)];
        Place place = Place::of_line(program_->main().name(), line);
        place.source = std::string(program_->main().line(line));
        throw InputError(place, what);
    };
    while (next_motion_ < motions.size()) {
        const std::int64_t m = next_motion_++;
        const auto i = static_cast<std::size_t>(m);
        follow_events(m);
        const MotionKind kind = motions.kind[i];
        if (kind == MotionKind::dwell) {
            pending_dwell_ += std::max(0.0F, motions.feed[i]);
            pending_dwell_line_ = motions.line[i];
            continue;
        }
        if (kind == MotionKind::spline) fail(m, "splines cannot be simulated yet");
        if (!motions.rotary.empty()) {
            const Xyz before = m > 0 ? motions.rotary[i - 1] : Xyz{};
            const Xyz& now = motions.rotary[i];
            const auto moved = [](double a, double b) { return b == b && b != a && !(a != a && b == 0); };
            if (moved(before.x, now.x) || moved(before.y, now.y) || moved(before.z, now.z)) {
                fail(m, "a rotary axis moves: only x, y and z can be simulated");
            }
        }
        const Xyz& to = motions.end[i];
        const Vec3 end(to.x == to.x ? to.x : at_.x(), to.y == to.y ? to.y : at_.y(), to.z == to.z ? to.z : at_.z());
        element = element_of(kind, is_arc(kind) ? motions.arc_of(m) : nullptr, at_, end);
        if (!(element.length > 0)) continue;
        element.line = motions.line[i];
        element.tolerance = tolerance_;
        element.feed = infinite;
        if (kind != MotionKind::rapid) {
            element.feed = motions.feed[i];
            if (!(element.feed > 0) || !std::isfinite(element.feed)) fail(m, "a feed motion without a feed greater than 0");
        }
        at_ = end;
        return true;
    }
    return false;
}

bool PathStream::stops_between(const PathElement& before, const PathElement& after) const {
    const Vec3 in = before.tangent(before.length);
    const Vec3 out = after.tangent(0);
    const double turning = deflection(in.normalized(), out.normalized());
    if (turning > reversal) return true;
    if (before.tolerance > 0 && after.tolerance > 0) return false;
    // On an exact path only what is straight on, with no jump of curvature, is passed without a stop.
    const double bend = (after.second_derivative(0) - before.second_derivative(before.length)).norm();
    return turning > straight_on || bend > least_bend_jump;
}

void PathStream::add_joint(const PathElement& before, const PathElement& after) {
    Joint joint;
    joint.at = ends_.back();
    joint.turn = after.tangent(0) - before.tangent(before.length);
    joint.turning = joint.turn.norm();
    if (joint.turning < straight_on) joint.turn.setZero(), joint.turning = 0;
    joint.tolerance = std::min(before.tolerance, after.tolerance);
    joint.bend = after.second_derivative(0) - before.second_derivative(before.length);
    const double bend = joint.bend.norm();
    if (bend > least_bend_jump) {
        // |d (v − |d|)³/(12 v²)| is greatest at v/4: 27/3072 v². The halves of a block keep the
        // roundings of its two ends apart.
        const double widest = std::sqrt(arc_share * joint.tolerance * 3072 / (27 * bend));
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
    section_end_ = at_;
    dwell_ = 0;
    dwell_line_ = 0;
    PathElement element;
    if (waiting_) {
        element = waiting_element_;
        waiting_ = false;
    } else if (!next_element(element)) {
        // Dwells at the very end still take their time.
        dwell_ = pending_dwell_;
        dwell_line_ = pending_dwell_line_;
        pending_dwell_ = 0;
        closed_ = true;
        return dwell_ > 0;
    }
    if (pending_dwell_ > 0) {
        // A wait before the first motion: a section without a way.
        dwell_ = pending_dwell_;
        dwell_line_ = pending_dwell_line_;
        pending_dwell_ = 0;
        waiting_ = true;
        waiting_element_ = element;
        section_end_ = element.begin;
        closed_ = true;
        return true;
    }
    elements_.push_back(element);
    ends_.push_back(element.length);
    element_count_ = 1;
    return true;
}

/// Takes one more element into the section; false: the section is closed.
bool PathStream::pull() {
    if (closed_) return false;
    PathElement element;
    const bool more = next_element(element);
    if (!more || pending_dwell_ > 0 || stops_between(elements_.back(), element)) {
        closed_ = true;
        closed_at_ = ends_.back();
        section_end_ = elements_.back().end;
        dwell_ = pending_dwell_;
        dwell_line_ = pending_dwell_line_;
        pending_dwell_ = 0;
        if (more) {
            waiting_ = true;
            waiting_element_ = element;
        }
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
    double widest = j.at;
    if (closed_) widest = std::min(widest, closed_at_ - j.at);
    if (i - reach_of_a_joint >= 0) widest = std::min(widest, j.at - joint(i - reach_of_a_joint).at);
    if (i + reach_of_a_joint <= last) widest = std::min(widest, joint(i + reach_of_a_joint).at - j.at);
    const double allowed = has_arcs_ ? (1 - arc_share) * j.tolerance : j.tolerance;
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
            const double allowed = has_arcs_ ? (1 - arc_share) * other.tolerance : other.tolerance;
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

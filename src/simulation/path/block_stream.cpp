#include "simulation/path/block_stream.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/not_finite.h"
#include "core/units.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

// As in docs/simulate.md#1-sections-between-stops.
constexpr double reversal_angle = 179.0 * rad_per_deg;
constexpr double cusp_length = 0.001;  ///< [mm] a curve that turns by more than 90° within it has a corner there

}  // namespace

BlockStream::BlockStream(MotionSource& source, const Machine& machine, const Vec3& start, Stops stops)
    : source_(&source), machine_(&machine), at_(start), section_ends_(stops) {
    take(PathMode{});
    // If the program defines its start, the axes begin there.
    const Xyz& known = source.program().motions.start;
    if (known.x == known.x) at_.x() = known.x;
    if (known.y == known.y) at_.y() = known.y;
    if (known.z == known.z) at_.z() = known.z;
}

bool BlockStream::stops_between(const PathElement& before, const PathElement& after) const {
    const double turning = deflection(before.tangent(before.length).normalized(), after.tangent(0).normalized());
    if (before.stops || turning > reversal_angle) return true;
    if (before.tolerance > 0 && after.tolerance > 0) return false;
    if (machine_->controller.corner == CornerMode::junction) return false;
    const bool splines = before.spline && after.spline;
    // On an exact path only joints without a turn and without a jump of curvature are passed without a stop.
    const double bend = (after.second_derivative(0) - before.second_derivative(before.length)).norm();
    return turning > (splines ? straight_on_of_splines : straight_on) ||
           bend > (splines ? least_bend_jump_of_splines : least_bend_jump);
}

void BlockStream::take(const PathMode& mode) {
    const ControllerSettings& controller = machine_->controller;
    const bool rounded = mode.block_end == BlockEnd::rounded && rounds_corners(controller);
    tolerance_ = !rounded ? 0 : std::isfinite(mode.tolerance) ? mode.tolerance : controller.tolerance;
    // The planner that decides itself how blocks end has a path without a tolerance.
    if (rounded && section_ends_ == Stops::programmed && std::isinf(mode.tolerance)) tolerance_ = mode.tolerance;
    const double of_program = controller.planner == PlannerKind::trapezoidal ? mode.merging_tolerance : 0;
    merging_tolerance_ = controller.merging_tolerance.value_or(of_program);
    stops_ = mode.block_end == BlockEnd::exact_stop;
}

void BlockStream::follow_events(std::int64_t motion) {
    events_.pass(source_->program().events, motion, [&](const ProgramEvent& event) {
        if (const PathMode* mode = event.path_mode()) take(*mode);
    });
}

double BlockStream::done() const {
    return static_cast<double>(taken_before_ + next_motion_) /
           static_cast<double>(std::max<std::int64_t>(1, source_->outline().motions));
}

/// False: the program has no more motions.
bool BlockStream::at_a_motion() {
    while (next_motion_ >= source_->piece_size()) {
        if (!source_->next_piece()) return false;
        taken_before_ += std::exchange(next_motion_, 0);
        events_ = {};
    }
    return true;
}

/// Whether a rotary axis moves.
bool BlockStream::turns(const Motions& motions, std::size_t motion) {
    const Xyz before = std::exchange(rotary_, motions.rotary.empty() ? Xyz{} : motions.rotary[motion]);
    const auto moved = [](double a, double b) { return b == b && b != a && !(a != a && b == 0); };
    return moved(before.x, rotary_.x) || moved(before.y, rotary_.y) || moved(before.z, rotary_.z);
}

/// The next motion with a length; adds up the dwells before it.
bool BlockStream::read(PathElement& element) {
    const Motions& motions = source_->program().motions;
    const auto fail = [&](std::int64_t m, const std::string& what, const std::string& hint = {}) {
        const SourceText& text = source_->program().main();
        const auto line = motions.line[static_cast<std::size_t>(m)];
        Place place = Place::of_line(text.name(), line);
        place.source = std::string(text.line(line));
        throw InputError(place, what, hint);
    };
    if (!parts_.empty()) {
        take_part(element);
        return true;
    }
    while (at_a_motion()) {
        const std::int64_t m = next_motion_++;
        const auto i = static_cast<std::size_t>(m);
        follow_events(m);
        const MotionKind kind = motions.kind[i];
        const bool turning = turns(motions, i);
        if (kind == MotionKind::dwell) {
            pending_dwell_ += std::max(0.0F, motions.feed[i]);
            pending_dwell_line_ = motions.line[i];
            continue;
        }
        if (turning)
            fail(m, "a rotary axis moves: only x, y and z can be simulated",
                 "--machine FILE with rotary axes and their kinematics simulates five");
        const Xyz& to = motions.end[i];
        const Vec3 end(to.x == to.x ? to.x : at_.x(), to.y == to.y ? to.y : at_.y(), to.z == to.z ? to.z : at_.z());
        const Curve* curve = kind == MotionKind::spline ? motions.curve_of(m) : nullptr;
        std::shared_ptr<const BezierCurve> span;
        if (curve != nullptr)
            span = curve->span->at(0).hasNaN() ? std::make_shared<const BezierCurve>(curve->span->with_unknown_at(at_))
                                               : curve->span;
        element = span ? element_of(span) : element_of(kind, is_arc(kind) ? motions.arc_of(m) : nullptr, at_, end);
        if (!(element.length > 0)) continue;
        element.line = motions.line[i];
        element.block = blocks_++;
        element.block_length = element.length;
        element.tolerance = tolerance_;
        element.merging_tolerance = merging_tolerance_;
        element.stops = stops_;
        element.feed = infinite;
        if (kind != MotionKind::rapid) {
            element.feed = motions.feed[i];
            if (!(element.feed > 0) || !std::isfinite(element.feed))
                fail(m, "a feed motion without a feed greater than 0");
        }
        at_ = end;
        if (span && divide(element)) take_part(element);
        return true;
    }
    return false;
}

/// A curve with a cusp is divided there: the tool reverses as at a corner.
bool BlockStream::divide(const PathElement& whole) {
    std::shared_ptr<const BezierCurve> rest = whole.spline;
    while (const auto cusp = rest->sharp_turn(cusp_length)) {
        const auto [from, to] = *cusp;
        parts_.push_back(element_of(std::make_shared<const BezierCurve>(rest->split_at(from).first)));
        rest = std::make_shared<const BezierCurve>(rest->split_at(to).second);
        const PathElement across = element_of(MotionKind::feed, nullptr, parts_.back().end, rest->at(0));
        if (across.length > 0) parts_.push_back(across);
    }
    if (parts_.empty()) return false;
    parts_.push_back(element_of(rest));
    for (PathElement& part : parts_) {
        part.take_block(whole);
        part.stops = whole.stops;
    }
    std::ranges::reverse(parts_);
    return true;
}

void BlockStream::take_part(PathElement& element) {
    element = parts_.back();
    parts_.pop_back();
    at_ = element.end;
}

void BlockStream::take_dwell() {
    dwell_ = pending_dwell_;
    dwell_line_ = std::exchange(pending_dwell_line_, 0);
    pending_dwell_ = 0;
    closed_ = true;
}

bool BlockStream::begin_section() {
    section_end_ = at_;
    dwell_ = 0;
    dwell_line_ = 0;
    closed_ = begun_ = false;
    if (waiting_) return true;
    if (!read(waiting_element_)) {
        // Dwells at the end of the program still take their time.
        take_dwell();
        return dwell_ > 0;
    }
    waiting_ = true;
    if (pending_dwell_ > 0) {
        // A dwell before the first motion is a section without length.
        section_end_ = waiting_element_.begin;
        take_dwell();
    }
    return true;
}

bool BlockStream::next(PathElement& element) {
    if (closed_) return false;
    if (!waiting_ && !read(waiting_element_)) {
        section_end_ = last_.end;
        take_dwell();
        return false;
    }
    waiting_ = true;
    const bool corner = section_ends_ == Stops::at_corners && begun_ && stops_between(last_, waiting_element_);
    if (begun_ && (pending_dwell_ > 0 || corner)) {
        section_end_ = last_.end;
        take_dwell();
        return false;
    }
    element = last_ = waiting_element_;
    waiting_ = false;
    begun_ = true;
    return true;
}

}  // namespace clsurf

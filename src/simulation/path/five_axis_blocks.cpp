#include "simulation/path/five_axis_blocks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/not_finite.h"
#include "core/units.h"

namespace clsurf {
namespace {

constexpr double derating = 0.97;          ///< share of the speed that exactly reaches the limit
constexpr double least_turn_angle = 1e-9;  ///< [rad] a smaller turn counts as none
constexpr int places_of_block = 4;         ///< number of places of a block for a first estimate of its speed
std::array<AxisLimits, 5> limits_of(const Machine& machine) {
    std::array<AxisLimits, 5> limits{};
    for (std::size_t k = 0; k < 5; ++k) {
        const MachineAxis& a = k < 3 ? machine.axes[k] : machine.rotary[k - 3];
        limits[k] = {a.travel_low, a.travel_high, a.max_speed, a.max_acceleration,
                     a.max_jerk > 0 ? a.max_jerk : infinite};
    }
    // Travel limits apply to the displayed axis values.
    const std::array<double, 2> signs{machine.kinematics.tilt.sign, machine.kinematics.rotation.sign};
    for (std::size_t k = 0; k < 2; ++k) {
        AxisLimits& l = limits[3 + k];
        if (signs[k] < 0) std::tie(l.low, l.high) = std::pair(-l.high, -l.low);
    }
    return limits;
}

}  // namespace

FiveAxisBlocks::FiveAxisBlocks(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start)
    : machine_(&machine), zero_(zero), limits_(limits_of(machine)), planned_(program) {
    Motions& motions = planned_.motions;
    const std::size_t n = motions.kind.size();
    elements_.resize(n);
    axis_paths_.resize(n);
    caps_.assign(n, infinite);
    turn_speeds_.assign(n, infinite);
    Vec3 at = start;
    for (int k = 0; k < 3; ++k) {
        const double known = motions.start.vec()[k];
        if (known == known) at[k] = known;
    }
    RotaryAngles angles;
    for (std::size_t i = 0; i < n; ++i) {
        const auto motion = static_cast<std::int64_t>(i);
        const Vec3 word = motions.end[i].vec();
        const Vec3 end = word.array().isNaN().select(at, word);
        MotionKind& kind = motions.kind[i];
        const Curve* curve = kind == MotionKind::spline ? motions.curve_of(motion) : nullptr;
        if (kind == MotionKind::spline && curve == nullptr) kind = MotionKind::feed;  // a chord
        if (curve != nullptr)
            elements_[i] = element_of(std::make_shared<const BezierCurve>(curve->span->with_unknown_at(at)));
        else if (kind != MotionKind::dwell)
            elements_[i] = element_of(kind, is_arc(kind) ? motions.arc_of(motion) : nullptr, at, end);
        const RotaryAngles to = motions.rotary.empty() ? angles : machine.kinematics.angles_of(motions.rotary[i].vec());
        const bool cuts = kind != MotionKind::rapid && kind != MotionKind::dwell;
        if (cuts && !(motions.feed[i] > 0))
            throw InputError(Place::of_line(program.main().name(), motions.line[i]),
                             "a feed motion without a feed greater than 0");
        const double feed = kind == MotionKind::rapid || kind == MotionKind::dwell
                                ? machine.path.max_speed
                                : static_cast<double>(motions.feed[i]);
        axis_paths_[i] = make_axis_path(i, angles, to, feed);
        angles = axis_paths_[i].at(1);
        // A block that only turns is a dwell for the tip.
        if (kind != MotionKind::dwell && !(elements_[i].length > 0) && turn_of(i) > least_turn_angle) {
            if (cuts) turn_speeds_[i] = motions.feed[i] * rad_per_deg;
            kind = MotionKind::dwell;
            motions.feed[i] = static_cast<float>(turning_time(i));
        } else if (kind != MotionKind::dwell && elements_[i].length > 0) {
            guess_cap(i);
        }
        at = end;
    }
    feeds_ = motions.feed;
    kinds_ = motions.kind;
    lines_ = motions.line;
    for (std::size_t i = 0; i < n; ++i)
        motions.line[i] = static_cast<LineNumber>(i + 1);  // the samples contain their block
    motions.rotary = {};
    motions.tool_axis = {};
    motions.file = {};
    motions.call = {};
    apply_caps();
}

bool FiveAxisBlocks::derate(const std::vector<BlockExcess>& excesses) {
    bool derated = false;
    for (std::size_t i = 0; i < excesses.size(); ++i) {
        if (!(excesses[i].scale < 1)) continue;
        derated = true;
        const double scale = derating * excesses[i].scale;
        if (kinds_[i] == MotionKind::dwell)
            feeds_[i] = static_cast<float>(feeds_[i] / scale);
        else
            caps_[i] = std::min(caps_[i], std::max<double>(excesses[i].peak, 1e-3) * scale);
    }
    apply_caps();
    return derated;
}

void FiveAxisBlocks::forget_caps() {
    caps_.assign(count(), infinite);
    apply_caps();
}

double FiveAxisBlocks::part_at(std::size_t block, const Vec3& p, double from) const {
    const PathElement& e = elements_[block];
    if (!(e.length > 0)) return 1;
    double arc_length = 0;
    if (e.arc) {
        const Vec3 off = p - e.centre;
        const double full = 2 * std::numbers::pi / e.rate;
        arc_length = std::atan2(off.dot(e.second), off.dot(e.first)) / e.rate;
        arc_length += full * std::round((from * e.length - arc_length) / full);
    } else if (e.spline) {
        arc_length = e.spline->arc_length_to(e.spline->nearest(p, e.spline->at_arc_length(from * e.length)).t);
    } else {
        arc_length = (p - e.begin).dot(e.direction);
    }
    return std::clamp(arc_length / e.length, from, 1.0);
}

double FiveAxisBlocks::turn_of(std::size_t i) const {
    const RotaryAngles a = axis_paths_[i].at(0);
    const RotaryAngles b = axis_paths_[i].at(1);
    return std::max(std::abs(b.tilt - a.tilt), std::abs(b.rotation - a.rotation));
}

ToolAxisPath FiveAxisBlocks::make_axis_path(std::size_t i, const RotaryAngles& from, const RotaryAngles& to,
                                            double feed) const {
    const Kinematics& k = machine_->kinematics;
    const double angle = angle_between(k.axis_of(from), k.axis_of(to));
    const double time = elements_[i].length / std::max(feed, 1e-3);
    const double ratio = angle > 0 && time > 0 ? limits_[4].speed * time / angle : infinite;
    return {k, from, to, {limits_[3].low, limits_[3].high}, ratio, k.axis_tolerance};
}

/// The time of a turn from rest to rest that both axes can keep, at its feed or slower.
double FiveAxisBlocks::turning_time(std::size_t i) const {
    const RotaryAngles a = axis_paths_[i].at(0);
    const RotaryAngles b = axis_paths_[i].at(1);
    const std::array<double, 2> turns{std::abs(b.tilt - a.tilt), std::abs(b.rotation - a.rotation)};
    double time = std::hypot(turns[0], turns[1]) / (turn_speeds_[i] * machine_->controller.feed_override);
    for (std::size_t k = 0; k < 2; ++k) {
        if (!(turns[k] > least_turn_angle)) continue;
        const AxisLimits& l = limits_[3 + k];
        // s(u) = u³ (10 − 15 u + 6 u²): greatest s′ 15/8, s″ 10/√3, s‴ 60.
        time = std::max({time, 1.875 * turns[k] / l.speed, std::sqrt(5.7735026918962576 * turns[k] / l.acceleration),
                         std::cbrt(60 * turns[k] / l.jerk)});
    }
    return time;
}

/// A first estimate of the speed, from the axis distances between places of a block.
void FiveAxisBlocks::guess_cap(std::size_t i) {
    const PathElement& e = elements_[i];
    const Kinematics& k = machine_->kinematics;
    const auto axes_at = [&](double part) {
        const RotaryAngles angles = axis_paths_[i].at(part);
        const Vec3 linear = k.to_axes(e.at(part * e.length) + zero_, angles);
        return std::array<double, 5>{linear.x(), linear.y(), linear.z(), angles.tilt, angles.rotation};
    };
    std::array<double, 5> before = axes_at(0);
    const double step = e.length / places_of_block;
    for (int j = 1; j <= places_of_block; ++j) {
        const std::array<double, 5> now = axes_at(static_cast<double>(j) / places_of_block);
        for (std::size_t axis = 0; axis < 5; ++axis) {
            const double slope = std::abs(now[axis] - before[axis]) / step;
            // The planner limits the speed of an axis that moves no farther than the tip.
            if (axis < 3 ? slope <= 1 + 1e-9 : slope * e.length <= least_turn_angle) continue;
            caps_[i] = std::min(caps_[i], derating * limits_[axis].speed / slope);
        }
        before = now;
    }
}

void FiveAxisBlocks::apply_caps() {
    Motions& motions = planned_.motions;
    for (std::size_t i = 0; i < count(); ++i) {
        motions.feed[i] = feeds_[i];
        motions.kind[i] = kinds_[i];
        if (kinds_[i] == MotionKind::dwell || !(caps_[i] < infinite)) continue;
        if (kinds_[i] == MotionKind::rapid) {
            motions.kind[i] = MotionKind::feed;
            motions.feed[i] = static_cast<float>(caps_[i]);
        } else {
            motions.feed[i] = std::min(feeds_[i], static_cast<float>(caps_[i]));
        }
    }
}

}  // namespace clsurf

#include "simulation/plan/five_axis_limits.h"

#include <algorithm>
#include <cmath>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr double steady_share = 0.8;  ///< greatest share of the limits that bends alone may use
constexpr double turn_in_ramp = 0.1;  ///< share of ramp(): least time of the first speeds for a distance of two radii

/// The speed of u at which the steps of a period stay within the chord error. Between two places at the distance h a curve
/// is at most h²/8 of the second derivative from its chord. If the tip nearly reverses, the radius is almost 0 over a
/// distance shorter than a step: the rule for arcs would nearly stop the tip there, and more so with a longer period.
double chord_cap(double radius, double pace, double second, const ControllerSettings& controller) {
    const double error = controller.chord_tolerance, period = controller.period;
    return std::max(chord_speed(radius, error, period) / pace, std::sqrt(8 * error / second) / period);
}

}  // namespace

FiveAxisLimits::FiveAxisLimits(const FiveAxisPath& path, const Machine& machine)
    : path_(&path), machine_(&machine), limits_(five_axis_limits(machine)) {
    for (int k = 0; k < 5; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        speeds_[k] = k < 3 ? machine.axes[axis].max_speed : machine.rotary[axis - 3].max_speed;
        if (limits_.jerk[k] > 0) ramp_ = std::min(ramp_, limits_.acceleration[k] / limits_.jerk[k]);
    }
    ramp_ = std::min(ramp_, machine.path.max_acceleration / machine.path.max_jerk);
}

LimitPlace FiveAxisLimits::at(double u) const {
    AxisSample<5> sample;
    return at(u, sample);
}

LimitPlace FiveAxisLimits::at(double u, AxisSample<5>& d) const {
    PathDerivatives tip;
    d = path_->derivatives(u, tip);
    LimitPlace place;
    place.u = u;
    const FiveAxisChord& chord = path_->chord(path_->chord_at(u));
    const auto cap = [&](double speed, LimitingFactor why) {
        if (speed < place.free_cap) place.free_cap = speed, place.why = why;
    };
    const LimitingFactor feed =
        machine_->controller.feed_override == 1 ? LimitingFactor::feed : LimitingFactor::feed_override;
    cap(chord.turn_speed / d.first.tail<2>().norm(), feed);
    if (d.pace.value > 0) {
        cap(chord.feed / d.pace.value, feed);
        cap(machine_->path.max_speed / d.pace.value, LimitingFactor::axis_speed);
        const double cross_product = tip.first.cross(tip.second).norm();
        if (cross_product > 0) {
            const double radius = d.pace.value * d.pace.value * d.pace.value / cross_product;
            cap(arc_speed(radius, machine_->path.max_normal_acceleration) / d.pace.value,
                LimitingFactor::axis_acceleration);
            // If the tip nearly reverses, first speeds are so low that cells are as short as the turn.
            place.cap = 2 * radius / (d.pace.value * ramp_ * turn_in_ramp);
            cap(chord_cap(radius, d.pace.value, tip.second.norm(), machine_->controller), LimitingFactor::chord_error);
        }
    }
    place.acceleration = place.jerk = infinite;
    if (d.pace.value > 0) {
        place.acceleration = machine_->path.max_acceleration / d.pace.value;
        place.jerk = machine_->path.max_jerk / d.pace.value;
    }
    for (int k = 0; k < 5; ++k) {
        const double first = std::abs(d.first[k]), second = std::abs(d.second[k]), third = std::abs(d.third[k]);
        cap(speeds_[k] / first, LimitingFactor::axis_speed);
        place.acceleration = std::min(place.acceleration, limits_.acceleration[k] / first);
        place.cap = std::min(place.cap, std::sqrt(steady_share * limits_.acceleration[k] / second));
        if (!(limits_.jerk[k] > 0)) continue;
        place.jerk = std::min(place.jerk, limits_.jerk[k] / first);
        place.cap = std::min(place.cap, std::cbrt(steady_share * limits_.jerk[k] / third));
    }
    place.cap = std::min(place.cap, place.free_cap);
    return place;
}

std::vector<LimitPlace> FiveAxisLimits::at_places() const {
    std::vector<LimitPlace> places;
    for (const double u : path_->places()) places.push_back(at(u));
    return places;
}

bool FiveAxisLimits::hold(double u, int side, double speed, double acceleration, double jerk) const {
    AxisSample<5> d;
    if (speed > at(u, d).free_cap) return false;
    const auto held = [&](double first, double second, double third, double most, double jerk_limit) {
        if (std::abs(first * acceleration + second * speed * speed) > most) return false;
        const double third_in_time = first * jerk + speed * (3 * second * acceleration + third * speed * speed);
        return !(jerk_limit > 0) || std::abs(third_in_time) <= jerk_limit;
    };
    for (int k = 0; k < 5; ++k) {
        if (!held(d.first[k], side * d.second[k], d.third[k], limits_.acceleration[k], limits_.jerk[k])) return false;
    }
    return held(d.pace.value, side * d.pace.slope, d.pace.curve, limits_.path_acceleration, limits_.path_jerk);
}

}  // namespace clsurf

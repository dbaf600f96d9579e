#include "simulation/plan/scurve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "numeric/root_between.h"

namespace clsurf {
namespace {

// A distance is long enough for a ramp if less than this is missing: speeds from reach() have rounding errors relative to
// the distance.
constexpr double relative_tolerance = 1e-9;
constexpr double absolute_tolerance = 1e-12;  ///< [mm]
constexpr double speed_tolerance = 4 * std::numeric_limits<double>::epsilon();

constexpr std::array<double, 7> jerk_signs{1, 0, -1, 0, -1, 0, 1};

struct Ramp {
    double jerk_part = 0, constant_part = 0;
};

Ramp ramp_of(double difference, double acceleration, double jerk) {
    if (difference <= acceleration * (acceleration / jerk)) return {std::sqrt(difference / jerk), 0.0};
    return {acceleration / jerk, difference / acceleration - acceleration / jerk};
}

MotionState advance(const MotionState& from, double t, double jerk) {
    return {from.arc_length + t * (from.speed + t * (0.5 * from.acceleration + t * jerk / 6)),
            from.speed + t * (from.acceleration + 0.5 * t * jerk), from.acceleration + t * jerk};
}

/// The peak speed v, at least both end speeds, for which the two ramps cover the arc length. Their length increases
/// strictly with v.
double peak_speed(double arc_length, double vs, double ve, const RampLimits& limits) {
    const auto excess = [&](double v) {
        return ramp_distance(vs, v, limits.acceleration, limits.jerk) +
               ramp_distance(v, ve, limits.deceleration, limits.jerk) - arc_length;
    };
    double low = std::max(vs, ve);
    double high = limits.speed;
    if (!std::isfinite(high))
        high = reach(low, arc_length, std::max(limits.acceleration, limits.deceleration), limits.jerk);
    const double at_low = excess(low);
    const double at_high = excess(high);
    if (at_low >= 0) return low;
    if (at_high <= 0) return high;
    return root_between(low, at_low, high, at_high, 1e-15, 1e-15 * arc_length, excess);
}

}  // namespace

double ramp_time(double difference, double acceleration, double jerk) {
    const Ramp ramp = ramp_of(difference, acceleration, jerk);
    return 2 * ramp.jerk_part + ramp.constant_part;
}

double ramp_distance(double v0, double v1, double acceleration, double jerk) {
    return 0.5 * (v0 + v1) * ramp_time(std::abs(v1 - v0), acceleration, jerk);
}

double reach(double v0, double arc_length, double acceleration, double jerk) {
    if (arc_length <= 0) return v0;
    const double p = 2 * v0 / jerk;
    const double q = arc_length / jerk;
    double t = 0;
    // Below this p³ is lost in rounding against q²: the cubic is then t³ = q.
    if (p * p * p < 1e-30 * q * q) {
        t = std::cbrt(q);
    } else {
        const double root = std::sqrt(p / 3);
        t = 2 * root * std::sinh(std::asinh(1.5 * q / (p * root)) / 3);
    }
    if (jerk * t <= acceleration) return v0 + jerk * t * t;
    const double h = acceleration * acceleration / (2 * jerk);
    return -h + std::sqrt((h - v0) * (h - v0) + 2 * acceleration * arc_length);
}

SCurve::SCurve(double start_speed, double jerk, const std::array<double, 7>& durations)
    : durations_(durations), jerk_(jerk) {
    MotionState state{0, start_speed, 0};
    double time = 0;
    for (std::size_t i = 0; i < 7; ++i) {
        starts_[i] = state;
        state = advance(state, durations[i], jerk_signs[i] * jerk);
        if (i == 2 || i == 6) state.acceleration = 0;  // exactly, without rounding
        time += durations[i];
        ends_[i] = time;
    }
    length_ = state.arc_length;
    end_speed_ = state.speed;
}

void SCurve::pin_end(double length, double end_speed) {
    length_ = length;
    end_speed_ = end_speed;
}

MotionState SCurve::in_phase(int phase, double t) const {
    const auto i = static_cast<std::size_t>(phase);
    return advance(starts_[i], t - (ends_[i] - durations_[i]), jerk_signs[i] * jerk_);
}

MotionState SCurve::at(double t) const {
    if (t >= ends_[6]) return {length_, end_speed_, 0};
    int phase = 0;
    while (phase < 6 && t >= ends_[static_cast<std::size_t>(phase)]) ++phase;
    return in_phase(phase, std::max(t, 0.0));
}

double SCurve::time_at(double arc_length) const {
    if (arc_length <= 0) return 0;
    if (arc_length >= length_) return duration();
    std::size_t phase = 0;
    while (phase < 6 && arc_length >= starts_[phase + 1].arc_length) ++phase;
    const MotionState& start = starts_[phase];
    const double begin = ends_[phase] - durations_[phase];
    const double jerk = jerk_signs[phase] * jerk_;
    // With the acceleration at the start of the phase: exact without jerk.
    const double left = arc_length - start.arc_length;
    double t =
        2 * left / (start.speed + std::sqrt(std::max(0.0, start.speed * start.speed + 2 * start.acceleration * left)));
    if (jerk == 0) return begin + std::min(t, durations_[phase]);
    double low = 0;
    double high = durations_[phase];
    if (!(t < high)) t = 0.5 * high;
    for (int i = 0; i < 100 && high - low > 1e-15 * ends_[6]; ++i) {
        const MotionState s = advance(start, t, jerk);
        const double excess = s.arc_length - arc_length;
        if (std::abs(excess) <= 1e-14 * length_) break;
        (excess < 0 ? low : high) = t;
        const double next =
            s.speed > 0 ? t - excess * s.speed / (s.speed * s.speed - 0.5 * excess * s.acceleration) : low;
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return begin + t;
}

PlannedProfile plan_scurve(double arc_length, double start_speed, double end_speed, const RampLimits& limits) {
    PlannedProfile plan;
    const double vs = start_speed;
    double ve = end_speed;
    const double towards = ve > vs ? limits.acceleration : limits.deceleration;
    plan.needed_arc_length = ramp_distance(vs, ve, towards, limits.jerk);
    // A difference of speeds contains their rounding. If the distance is within that rounding, the ramp fits.
    const double rounding = speed_tolerance * std::max(vs, ve);
    const double least_arc_length =
        0.5 * (vs + ve) * ramp_time(std::max(0.0, std::abs(ve - vs) - rounding), towards, limits.jerk);
    if (least_arc_length > arc_length * (1 + relative_tolerance) + absolute_tolerance) {
        if (ve < vs) {
            plan.status = ProfileStatus::infeasible_decel;
            plan.allowed_start = reach(ve, arc_length, limits.deceleration, limits.jerk);
            return plan;
        }
        plan.status = ProfileStatus::end_speed_lowered;
        ve = std::min(reach(vs, arc_length, limits.acceleration, limits.jerk), limits.speed);
    }
    const double at_limit = std::isfinite(limits.speed)
                                ? ramp_distance(vs, limits.speed, limits.acceleration, limits.jerk) +
                                      ramp_distance(limits.speed, ve, limits.deceleration, limits.jerk)
                                : arc_length + 1;
    double peak = limits.speed;
    double cruise = 0;
    if (at_limit <= arc_length)
        cruise = arc_length > at_limit ? (arc_length - at_limit) / limits.speed : 0.0;
    else
        peak = peak_speed(arc_length, vs, ve, limits);
    const Ramp up = ramp_of(peak - vs, limits.acceleration, limits.jerk);
    const Ramp down = ramp_of(peak - ve, limits.deceleration, limits.jerk);
    plan.profile = SCurve(
        vs, limits.jerk,
        {up.jerk_part, up.constant_part, up.jerk_part, cruise, down.jerk_part, down.constant_part, down.jerk_part});
    plan.profile.pin_end(arc_length, ve);
    return plan;
}

RunningRamp ramp_from_state(double v0, double a0, double v1, double acceleration, double jerk) {
    const double stop = v0 + a0 * std::abs(a0) / (2 * jerk);
    const double sign = v1 >= stop ? 1.0 : -1.0;
    double peak = sign * std::sqrt(std::max(0.0, sign * jerk * (v1 - v0) + 0.5 * a0 * a0));
    RunningRamp ramp;
    if (std::abs(peak) > acceleration) {
        peak = sign * acceleration;
        ramp.durations[1] = (v1 - v0 - sign * (2 * peak * peak - a0 * a0) / (2 * jerk)) / peak;
    }
    ramp.durations[0] = sign * (peak - a0) / jerk;
    ramp.durations[2] = std::abs(peak) / jerk;
    ramp.jerks = {sign * jerk, 0.0, -sign * jerk};
    MotionState state{0, v0, a0};
    for (std::size_t i = 0; i < 3; ++i) state = advance(state, ramp.durations[i], ramp.jerks[i]);
    ramp.arc_length = state.arc_length;
    return ramp;
}

}  // namespace clsurf

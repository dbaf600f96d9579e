#include "intervals/intervals.h"

#include <algorithm>
#include <cmath>

#include "simulation/path/junction.h"

namespace clsurf {

SpeedLimits speed_limits_of(const Machine& machine) {
    return {machine.path.max_normal_acceleration, machine.path.max_jerk, machine.controller.chord_tolerance,
            machine.controller.period};
}

double planned_speed(const SpeedInterval& interval, double feed, const SpeedLimits& limits) {
    double speed = feed;
    if (interval.mean_curvature > 0)
        speed = std::min(speed, std::sqrt(limits.normal_acceleration / interval.mean_curvature));
    const double curvature = interval.greatest_curvature;
    if (!(curvature > 0)) return speed;
    speed = std::min(speed, std::sqrt(limits.normal_acceleration / curvature));
    if (limits.chord_tolerance > 0)
        speed = std::min(speed, chord_speed(1 / curvature, limits.chord_tolerance, limits.period));
    if (limits.jerk > 0) speed = std::min(speed, std::cbrt(limits.jerk / (curvature * curvature)));
    return speed;
}

}  // namespace clsurf

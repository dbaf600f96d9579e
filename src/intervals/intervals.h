#pragma once
// The speed at which a constant-speed interval can be run.

#include "machine/machine.h"
#include "numeric/speed_intervals.h"

namespace clsurf {

/// Limits of the speed of an interval.
struct SpeedLimits {
    double normal_acceleration = 1500;  ///< [mm/s²]
    double jerk = 0;                    ///< [mm/s³] jerk of the path on a bend; 0: not limited
    double chord_tolerance = 0;         ///< [mm] tolerance of the chord of one period; 0: not limited
    double period = 0.001;              ///< [s]
};
[[nodiscard]] SpeedLimits speed_limits_of(const Machine& machine);

/// The highest speed of an interval [mm/s], at most `feed`.
[[nodiscard]] double planned_speed(const SpeedInterval& interval, double feed, const SpeedLimits& limits);

}  // namespace clsurf

#pragma once
// What a simulation on five axes gives for each period, and the summary of all of them.

#include <array>
#include <functional>
#include <span>

#include "simulation/run/simulated_point.h"

namespace clsurf {

/// A record of the log: x, y, z [mm], tilt, rotation [rad], signs applied.
struct FiveAxisPoint {
    std::array<double, 5> commanded{}, feedback{};
    double speed = 0;  ///< of the tip [mm/s]
    LineNumber line = 0;
    LimitingFactor limit = LimitingFactor::none;
};

struct FiveAxisSummary {
    SimulationSummary run;  ///< speeds, accelerations and jerks of the linear axes, the path's speed that of the tip
    std::array<double, 2> max_speed{}, max_acceleration{}, max_jerk{};  ///< of tilt and rotation [rad/s^d]
    double orientation_error =
        0;                ///< greatest angle between a set point at feed and the great circle of its block [rad]
    bool axes_ok = true;  ///< of run.limits_ok: the limits of the axes
    int rounds = 0;       ///< 0: planned on one path
};

using FiveAxisSink = std::function<void(std::span<const FiveAxisPoint>)>;

}  // namespace clsurf

#pragma once
// The result of a simulation on five axes for each period, and its summary.

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
    SimulationSummary run;  ///< speeds, accelerations and jerks of the linear axes; the path speed is that of the tip
    std::array<double, 2> max_speed{}, max_acceleration{}, max_jerk{};  ///< of tilt and rotation [rad/s^d]
    double orientation_error =
        0;                ///< greatest angle between a set point at feed and the great circle of its block [rad]
    bool axes_ok = true;  ///< part of run.limits_ok: the limits of the axes
    int rounds = 0;       ///< of derating (simulate_five_axis()); 0: planned on one path
};

using FiveAxisSink = std::function<void(std::span<const FiveAxisPoint>)>;

}  // namespace clsurf

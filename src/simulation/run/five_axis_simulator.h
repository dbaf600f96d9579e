#pragma once
// Five axes: the tip path is planned as on three axes (simulation/run/simulator.h). The tool axis moves along with it.
// In each period the tip and the angles become positions of all five axes, and servo loops follow these.
//
// Within a block the angles are functions of arc length. Where blocks meet they are smoothed in time over a
// few periods. Angles that a rounded corner skips are recovered after it. The tip stays on its path, because
// the linear axes are computed from the smoothed angles. A trial run finds what the axes cannot follow: blocks
// on which speed, acceleration or jerk of an axis is too high become slower, in rounds, until all limits hold.
// After some rounds the jerk of the tip is lowered too. Cost: one planner run per round.

#include <functional>
#include <span>

#include "core/diagnostic.h"
#include "core/progress.h"
#include "machine/machine.h"
#include "simulation/run/simulator.h"

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
        0;  ///< greatest angle between a set point at feed and the great circle of its block [rad]
    int rounds = 0;
};

using FiveAxisSink = std::function<void(std::span<const FiveAxisPoint>)>;

/// `program`: motions of the tip with their angles (toolpath/tip_motions.h has both). `start`: where the tip
/// stands, angles at 0; `zero`: the machine position of the program's zero [mm]. Throws InputError as simulate().
[[nodiscard]] FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero,
                                                 const Vec3& start, const FiveAxisSink& sink, const Progress& progress);

}  // namespace clsurf

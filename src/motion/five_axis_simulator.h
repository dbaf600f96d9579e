#pragma once
// Five axes: the way of the tool's tip is planned as that of three (motion/simulator.h); the tool axis goes
// along, each period's tip and angles become positions of all five axes, and servo loops follow those.
//
// Angles are functions of the way within a block, smoothed in time over a few periods where blocks meet; what
// a rounded corner skips of them is made up for behind it.
// The tip keeps to its path meanwhile, because the linear axes are computed from what the angles are.
// What the axes cannot run is found by running it: blocks on which speed, acceleration or jerk of an axis is too
// great are made slower, in rounds, until all limits hold; after some rounds the tip's jerk is lowered, too. Cost: that of
// the planner a round.

#include <functional>
#include <span>

#include "core/diagnostic.h"
#include "core/progress.h"
#include "machine/machine.h"
#include "motion/simulator.h"

namespace clsurf {

/// A record of the log: x, y, z [mm], tilt, rotation [rad], signs applied.
struct FiveAxisPoint {
    std::array<double, 5> commanded{}, feedback{};
    double speed = 0;  ///< of the tip [mm/s]
    LineNumber line = 0;
    Ruling limit = Ruling::none;
};

struct FiveAxisSummary {
    SimulationSummary run;  ///< speeds, accelerations and jerks of the linear axes, the path's speed that of the tip
    std::array<double, 2> max_speed{}, max_acceleration{}, max_jerk{};  ///< of tilt and rotation [rad/s^d]
    double orientation_error =
        0;  ///< greatest angle between a set point at feed and the great circle of its block [rad]
    int rounds = 0;
};

using FiveAxisSink = std::function<void(std::span<const FiveAxisPoint>)>;

/// `program`: motions of the tip with their angles (path/tip_motions.h has both). `start`: where the tip
/// stands, angles at 0; `zero`: the machine position of the program's zero [mm]. Throws InputError as simulate().
[[nodiscard]] FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero,
                                                 const Vec3& start, const FiveAxisSink& sink, const Progress& progress);

}  // namespace clsurf

#pragma once
// Simulation on five axes: all axes are planned on one path (simulation/run/five_axis_run.h), and servo loops follow it.
//
// Some planners have corners without continuous curvature (trapezoidal, `junction`). They plan the tip alone, as on three
// axes. The angles are then smoothed in time over a few periods where blocks meet. Blocks on which an axis exceeds a limit
// become slower in several rounds. Cost: one planner run per round.

#include "core/progress.h"
#include "machine/machine.h"
#include "program/program.h"
#include "simulation/run/five_axis_point.h"

namespace clsurf {

/// `program`: motions of the tip with their angles (toolpath/tip_motions.h has both). `start`: position of the tip at
/// angles 0; `zero`: the machine position of the program's zero [mm]. Throws InputError as simulate().
[[nodiscard]] FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero,
                                                 const Vec3& start, const FiveAxisSink& sink, const Progress& progress);

}  // namespace clsurf

#pragma once
// Five axes: all axes are planned on one path (simulation/run/five_axis_run.h), and servo loops follow their positions.
//
// Planners whose corners are no curve of continuous curvature (trapezoidal, `junction`) plan the tip alone, as on three
// axes. There the angles are smoothed in time over a few periods where blocks meet, and in rounds blocks on which an
// axis exceeds a limit become slower. Cost: one planner run per round.

#include "core/progress.h"
#include "machine/machine.h"
#include "program/program.h"
#include "simulation/run/five_axis_point.h"

namespace clsurf {

/// `program`: motions of the tip with their angles (toolpath/tip_motions.h has both). `start`: where the tip
/// stands, angles at 0; `zero`: the machine position of the program's zero [mm]. Throws InputError as simulate().
[[nodiscard]] FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero,
                                                 const Vec3& start, const FiveAxisSink& sink, const Progress& progress);

}  // namespace clsurf

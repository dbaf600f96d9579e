#pragma once
// Five axes on one path. Blocks become a curve of all axes (path/five_axis_path.h), speeds are planned along it under the
// limits of each axis (plan/five_axis_speeds.h), and set points are places on it. Blocks in which only the angles move run
// from rest to rest.

#include "core/progress.h"
#include "machine/machine.h"
#include "program/program.h"
#include "simulation/path/five_axis_blocks.h"
#include "simulation/run/five_axis_point.h"

namespace clsurf {

/// Arguments as for simulate_five_axis(); `blocks`: of the program. Memory: for the longest section between rests.
[[nodiscard]] FiveAxisSummary run_five_axes(const Program& program, const Machine& machine, FiveAxisBlocks blocks,
                                            const Vec3& start, const FiveAxisSink& sink, const Progress& progress);

}  // namespace clsurf

#pragma once
// The trapezoidal planner (PlannerKind::trapezoidal), after LinuxCNC 2.9: constant accelerations, blocks that overlap at
// corners, arcs in corners, block times that are whole periods.
//
// Its parts: segment_of() derives the limits of a block from those of the axes along it; SegmentQueue decides how each
// block passes into the next one and scans back over the look-ahead; blend_corner() makes the arcs; SegmentRunner moves the
// axes, one period at a time; BlockMerging joins blocks first (G64 Q).

#include "core/progress.h"
#include "machine/machine.h"
#include "simulation/run/simulated_point.h"

namespace clsurf {

/// As simulate(), for machines with this planner. Throws InputError.
[[nodiscard]] SimulationSummary simulate_trapezoids(MotionSource& source, const Machine& machine, const Vec3& start,
                                                    const PointSink& sink, const Progress& progress);

}  // namespace clsurf

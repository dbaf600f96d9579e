#pragma once
// Controller simulation: from a program and a machine to the contents of the interpolation log.

#include "core/diagnostic.h"
#include "core/progress.h"
#include "machine/machine.h"
#include "simulation/run/simulated_point.h"

namespace clsurf {

/// How speeds are planned.
enum class Planning : std::uint8_t {
    nearly_optimal,  ///< accelerations are carried through the nodes (refiner.h)
    by_nodes,        ///< acceleration is zero at every node: slower, and gentler to everything that moves
};

/// Plans, interpolates and follows a program; passes points to `sink` in order, in blocks.
/// Memory: for the look-ahead and the source. Throws InputError (feed 0, rotary axes).
[[nodiscard]] SimulationSummary simulate(MotionSource& source, const Machine& machine, const Vec3& start,
                                         const PointSink& sink, const Progress& progress = {},
                                         Planning planning = Planning::nearly_optimal);
/// The same for a program in memory.
[[nodiscard]] SimulationSummary simulate(const Program& program, const Machine& machine, const Vec3& start,
                                         const PointSink& sink, const Progress& progress = {},
                                         Planning planning = Planning::nearly_optimal);

}  // namespace clsurf

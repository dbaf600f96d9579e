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
    by_nodes,        ///< acceleration is zero at every node: slower, and gentler to whatever moves along
};

/// Plans, interpolates and follows a program; points go to `sink` in order, block by block.
/// Memory: of the look-ahead and of the source. Throws InputError (feed 0, rotary axes).
[[nodiscard]] SimulationSummary simulate(MotionSource& source, const Machine& machine, const Vec3& start,
                                         const PointSink& sink, const Progress& progress = {},
                                         Planning planning = Planning::nearly_optimal);
/// The same of a program in memory.
[[nodiscard]] SimulationSummary simulate(const Program& program, const Machine& machine, const Vec3& start,
                                         const PointSink& sink, const Progress& progress = {},
                                         Planning planning = Planning::nearly_optimal);

}  // namespace clsurf

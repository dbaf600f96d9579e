#pragma once
// Parts of a program without a log: as programmed, or as a machine would run it.

#include "core/progress.h"
#include "pipeline/part.h"
#include "simulation/run/simulator.h"

namespace clsurf {

/// The programmed path, with its programmed values (pipeline/program_fields.h).
struct ProgrammedPart {
    Part part;  ///< its log has as many records as the surface has points, and no channels
    ClSurface surface;
};

/// Points on the programmed path: ends of motions, and more along long ones (surface/programmed_surface.h). `program` is in
/// the displayed coordinates. O(points).
[[nodiscard]] ProgrammedPart programmed_part(Program program);

/// A simulated part, with the summary of its run.
struct SimulatedPart {
    Part part;
    SimulationSummary summary;
};

/// Simulates a program on `rules.machine` (nullptr: the default one) from `start` [mm], and combines both. `program` has
/// its motions as programmed. On three axes the program's own work offsets are used. Throws UsageError: `rules.poses` has a
/// zero that is no default, and the run is on three axes. Also throws what simulate_to_log() and assemble() throw.
[[nodiscard]] SimulatedPart simulated_part(Program program, PartRules rules, const Vec3& start = Vec3::Zero(),
                                           const Progress& progress = {});

}  // namespace clsurf

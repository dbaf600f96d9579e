#pragma once
// The run of a program on a simulated machine, as a log in memory.

#include "core/progress.h"
#include "log/log.h"
#include "machine/machine.h"
#include "program/frame_placement.h"
#include "program/program.h"
#include "simulation/run/simulator.h"

namespace clsurf {

/// Whether a program is run on five axes: it uses rotary axes or tool axes, and the machine has two rotary axes.
[[nodiscard]] bool runs_on_five_axes(const Program& program, const Machine& machine);

/// Transforms a program, read with its motions as programmed, for a simulation on five axes: the program's zero is the
/// origin, axes are parallel to those of the machine, and motions are those of the tip. `poses`: pose of its zero with both
/// angles at 0. `start`: as for simulate_to_log(). Returns machine = pose · workpiece, whose translation is the `zero` of
/// simulate_to_log(). Throws what solve_tool_axes() throws (toolpath/tip_motions.h). O(motions).
[[nodiscard]] Eigen::Isometry3d prepare_five_axes(Program& program, const Machine& machine, FramePoses poses,
                                                  const Vec3& start);

/// Transforms a program, read with its motions as programmed, for a simulation: on five axes as prepare_five_axes(), else
/// into `three_axes` by its own work offsets. Returns machine = pose · workpiece, whose translation is the `zero` of
/// simulate_to_log(); on three axes the identity. O(motions).
[[nodiscard]] Eigen::Isometry3d prepare_run(Program& program, const Machine& machine, const FramePoses& poses,
                                            const Vec3& start, Coordinates three_axes = Coordinates::machine);

struct SimulatedRun {
    Log log;  ///< cmd.*, fb.*, line, limit; owns its columns
    SimulationSummary summary;
};

/// Simulates a program from `start`, the position of the axes [mm]. `program` is in the coordinates of the log to be made.
/// If it runs on five axes, its motions are those of the tip (toolpath/tip_motions.h), and `zero` is the machine position
/// of its zero [mm], which the log has as its work offset. Throws what simulate() and simulate_five_axis() throw.
/// O(points), in the caller's thread; memory: 53 bytes per point, 85 on five axes.
[[nodiscard]] SimulatedRun simulate_to_log(const Program& program, const Machine& machine,
                                           const Vec3& start = Vec3::Zero(), const Progress& progress = {},
                                           const Vec3& zero = Vec3::Zero());

}  // namespace clsurf

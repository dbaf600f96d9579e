#pragma once
// The run of a program on a simulated machine, as a log in memory.

#include "core/progress.h"
#include "log/log.h"
#include "machine/machine.h"
#include "program/frame_placement.h"
#include "program/program.h"
#include "simulation/run/simulator.h"

namespace clsurf {

/// Whether a program is run on five axes: it names rotary axes or tool axes, and the machine has two to turn.
[[nodiscard]] bool runs_on_five_axes(const Program& program, const Machine& machine);

/// Brings a program, read with its motions as programmed, to where it is simulated on five axes: zero in its own, axes
/// along those of the machine, motions those of the tip. `poses`: where its zero lies, both angles zero. `start`: as
/// simulate_to_log() takes it. Returns
/// machine = pose · workpiece, whose translation is the `zero` of simulate_to_log(). Throws what solve_tool_axes()
/// throws (toolpath/tip_motions.h). O(motions).
[[nodiscard]] Eigen::Isometry3d prepare_five_axes(Program& program, const Machine& machine, FramePoses poses,
                                                  const Vec3& start);

/// Brings a program, read with its motions as programmed, to where it is simulated: as prepare_five_axes() does where it runs
/// on five axes, else into `three_axes` by its own work offsets. Returns machine = pose · workpiece, whose translation is the
/// `zero` of simulate_to_log(); on three axes the identity. O(motions).
[[nodiscard]] Eigen::Isometry3d prepare_run(Program& program, const Machine& machine, const FramePoses& poses,
                                            const Vec3& start, Coordinates three_axes = Coordinates::machine);

struct SimulatedRun {
    Log log;  ///< cmd.*, fb.*, line, limit; owns its columns
    SimulationSummary summary;
};

/// Runs a program from `start`, where the axes stand [mm]. `program` is in the coordinates that the log is to have. Of a
/// program that runs on five axes the motions are those of the tip (toolpath/tip_motions.h), and `zero` is the machine
/// position of its zero [mm], which the log names as its work offset. Throws what simulate() and simulate_five_axis()
/// throw. O(points), in the caller's thread; memory: 53 bytes a point, 85 on five axes.
[[nodiscard]] SimulatedRun simulate_to_log(const Program& program, const Machine& machine,
                                           const Vec3& start = Vec3::Zero(), const Progress& progress = {},
                                           const Vec3& zero = Vec3::Zero());

}  // namespace clsurf

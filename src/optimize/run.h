#pragma once
// JudgedRun: a run of a program, simulated or recorded, with what the predictor says of it.

#include <memory>
#include <string>

#include "log/log.h"
#include "machine/machine.h"
#include "motion/simulator.h"
#include "path/line_map.h"
#include "quality/defects.h"

namespace clsurf {

/// Whether a program is run on five axes: it names rotary axes or tool axes, and the machine has two to turn.
[[nodiscard]] bool runs_on_five_axes(const Program& program, const Machine& machine);

/// The run of a program on a machine, as a log in memory: cmd.*, fb.*, line.
struct SimulatedRun {
    Log log;
    SimulationSummary summary;
};
/// Of a program that runs on five axes the motions are those of the tip (path/tip_motions.h); `zero`: machine position of its
/// zero [mm]. Throws what simulate() and simulate_five_axis() throw. Memory: 52 bytes a point, 84 on five axes.
[[nodiscard]] SimulatedRun simulate_to_log(const Program& program, const Machine& machine, const Vec3& start,
                                           const Progress& progress, const Vec3& zero = Vec3::Zero());

struct JudgedRun {
    Log log;
    Trajectory path;  ///< commanded, or what the log has
    std::unique_ptr<LineMap> lines;
    ClSurface surface;
    Signals signals;
    QualityReport report;
    double duration = 0;  ///< [s]
    double mismatch = 0;  ///< [mm/s] 95th percentile of the speed difference to the neighbour passes
    Column<float>
        speed_differences;         ///< [mm/s] per point, to the neighbour pass that differs most; NaN: none beside it
    double greatest_mismatch = 0;  ///< [mm/s] 99.9th percentile of it
};

/// Stitches the surface of a log and judges it by `rules`. Adds diagnostics about lines to `diagnostics`. `kinematics`: of a
/// machine whose rotary axes the log has; the program's motions are then those of the tip. O(points), parallel.
[[nodiscard]] JudgedRun judge_run(Log log, const Program& program, const QualityRules& rules, Diagnostics& diagnostics,
                                  std::shared_ptr<const Kinematics> kinematics = nullptr);

}  // namespace clsurf

#pragma once
// JudgedRun: a run of a program, simulated or recorded, with the results of the predictor.

#include <memory>
#include <optional>
#include <string>

#include "log/log.h"
#include "machine/machine.h"
#include "mapping/line_map.h"
#include "pipeline/motion_quality.h"
#include "pipeline/roughness_gauge.h"
#include "pipeline/simulated_log.h"
#include "predictor/defects.h"
#include "repair/objective.h"

namespace clsurf {

/// The largest difference in speed between a defect and its adjacent passes [mm/s]; 0: no defect is one of speed.
[[nodiscard]] double largest_speed_jump(const QualityReport& report);

struct JudgedRun {
    Log log;
    Trajectory path;  ///< commanded, or the positions that the log has
    std::unique_ptr<LineMap> lines;
    ClSurface surface;
    Signals signals;
    QualityReport report;
    double duration = 0;              ///< [s] from the first to the last motion
    double mismatch = 0;              ///< [mm/s] 95th percentile of the speed difference to the adjacent passes
    Column<float> speed_differences;  ///< [mm/s] per point, to the adjacent pass that differs most; NaN: there is none
    double greatest_mismatch = 0;     ///< [mm/s] 99.9th percentile of the same difference
    std::optional<MotionQuality> motion{};  ///< if it was requested

    [[nodiscard]] GaugedRun gauged() const { return {log, path, *lines, surface, &report}; }
    [[nodiscard]] RunMeasures measures() const {
        return {.mismatch = mismatch,
                .defects = static_cast<double>(report.defects.size()),
                .duration = duration,
                .speed = static_cast<double>(report.thresholds.usual_speed),
                .defect_mismatch = largest_speed_jump(report)};
    }
};

/// Stitches the surface of a log and judges it as `check` does. Adds diagnostics about lines to `diagnostics`. `kinematics`: of
/// the machine if the log has its rotary axes; the motions of the program are then those of the tip. `identity`: what is known
/// about the program that ran; `same` for a simulation. `derivative`: method for speeds and accelerations. `with_motion`:
/// requests JudgedRun::motion. O(points), parallel.
[[nodiscard]] JudgedRun judge_run(Log log, const Program& program, Diagnostics& diagnostics,
                                  std::shared_ptr<const Kinematics> kinematics = nullptr,
                                  ProgramIdentity identity = ProgramIdentity::same,
                                  DerivativeMethod derivative = DerivativeMethod::savgol, bool with_motion = false);

}  // namespace clsurf

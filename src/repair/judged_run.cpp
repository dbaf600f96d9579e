#include "repair/judged_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/statistics.h"
#include "mapping/map_lines.h"
#include "pipeline/motion_quality.h"
#include "pipeline/placement.h"
#include "pipeline/roles.h"
#include "pipeline/signals_of.h"
#include "predictor/quality_fields.h"
#include "surface/smoothing_segments.h"
#include "surface/stitch.h"

namespace clsurf {

double largest_speed_jump(const QualityReport& report) {
    double largest = 0;
    for (const Defect& defect : report.defects) {
        if (defect.quantity == Quantity::speed) largest = std::max(largest, std::abs(defect.speed_jump));
    }
    return largest;
}

JudgedRun judge_run(Log log, const Program& program, Diagnostics& diagnostics,
                    std::shared_ptr<const Kinematics> kinematics, ProgramIdentity identity, DerivativeMethod derivative,
                    bool with_motion) {
    JudgedRun run;
    run.log = std::move(log);
    const Eigen::Isometry3d pose = pose_of(run.log).value_or(Eigen::Isometry3d::Identity());
    run.path = reconstruct(run.log, shown_role(run.log), pose, std::move(kinematics));
    run.lines = std::make_unique<LineMap>(map_lines(run.path, run.log, program, true, diagnostics, identity));
    run.surface = stitch(gather(run.path), *run.lines);
    const std::shared_ptr<const MotionEstimate> estimate =
        estimate_motion(derivative, run.log, run.path, run.surface.passes);
    run.signals = signals_along(run.log, run.path, run.surface, std::nullopt, estimate.get()).signals;
    run.report = find_defects(run.surface, run.signals, *run.lines, program, run.log.period, {});
    run.duration = time_in_motion(run.surface, run.log.period);
    run.speed_differences = speed_differences(run.surface, run.signals);
    if (with_motion) run.motion = motion_quality(run.log, run.path, run.surface, run.speed_differences, estimate);
    std::vector<float> sizes;
    for (const float value : run.speed_differences) {
        if (value == value) sizes.push_back(std::abs(value));
    }
    if (sizes.empty()) return run;
    run.mismatch = quantile_below(sizes, 0.95);
    run.greatest_mismatch = quantile_below(sizes, 0.999);
    return run;
}

}  // namespace clsurf

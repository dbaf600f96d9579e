#pragma once
// MotionQuality: how long a run takes, how much adjacent passes differ and how hard the axes are jerked, in a few numbers
// that runs can be compared by.

#include <memory>

#include "core/distribution.h"
#include "core/not_finite.h"
#include "log/log.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// NaN: not known. Percentiles are those of absolute values over all points that have one.
struct MotionQuality {
    double duration = missing<double>;      ///< [s] from the first to the last motion
    double mismatch = missing<double>;      ///< [mm/s] 95th percentile of the speed difference to the adjacent passes
    double mismatch_rms = missing<double>;  ///< [mm/s]
    double jerk = missing<double>;          ///< [mm/s³] 95th percentile of the jerk on cut passes (field `jerk`)
    double jerk_rms = missing<double>;      ///< [mm/s³]
};

/// [s] from the first to the last motion: a recording may begin early and end late.
[[nodiscard]] double time_in_motion(const ClSurface& surface, double period);

/// `speed_differences` [mm/s]: one value a point (predictor/quality_fields.h). `estimate`: what derives the jerk; nullptr: least
/// squares over a window. O(points), parallel.
[[nodiscard]] MotionQuality motion_quality(const Log& log, const Trajectory& path, const ClSurface& surface,
                                           const Column<float>& speed_differences,
                                           std::shared_ptr<const MotionEstimate> estimate = nullptr);

/// The distributions behind percentiles and rms values, for a part of the points. Those of all parts are added.
struct MotionSizes {
    Distribution mismatch;  ///< [mm/s]
    Distribution jerk;      ///< [mm/s³]

    void add(const MotionSizes& other) {
        mismatch.add(other.mismatch);
        jerk.add(other.jerk);
    }
};

/// Of points that begin and end where passes do. Derivatives are those of windows. O(points among `points`), parallel.
[[nodiscard]] MotionSizes motion_sizes(const Log& log, const Trajectory& path, const ClSurface& surface,
                                       const Signals& signals, const PointRange& points);

/// The quality of the whole from the distributions of all its points: percentiles within Distribution::quantile_error, all
/// else exact. O(standstill before and after the motion).
[[nodiscard]] MotionQuality motion_quality(const MotionSizes& sizes, const ClSurface& surface, double period);

}  // namespace clsurf

#pragma once
// MotionQuality: the duration of a run, the differences between adjacent passes and the jerk of the motion, in a few
// numbers by which runs can be compared.

#include <memory>

#include "core/distribution.h"
#include "core/not_finite.h"
#include "log/log.h"
#include "predictor/signals.h"
#include "surface/cl_surface.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// NaN: not known. Percentiles are those of absolute values over all points with a value.
struct MotionQuality {
    double duration = missing<double>;      ///< [s] from the first to the last motion
    double mismatch = missing<double>;      ///< [mm/s] 95th percentile of the speed difference to the adjacent passes
    double mismatch_rms = missing<double>;  ///< [mm/s]
    double jerk = missing<double>;          ///< [mm/s³] 95th percentile of the jerk on cut passes (field `jerk`)
    double jerk_rms = missing<double>;      ///< [mm/s³]
};

/// [s] from the first to the last motion: a recording may begin earlier and end later.
[[nodiscard]] double time_in_motion(const ClSurface& surface, double period);

/// `speed_differences` [mm/s]: one value per point (predictor/quality_fields.h). `estimate`: gives the jerk; nullptr: least
/// squares over a window. O(points), parallel.
[[nodiscard]] MotionQuality motion_quality(const Log& log, const Trajectory& path, const ClSurface& surface,
                                           const Column<float>& speed_differences,
                                           std::shared_ptr<const MotionEstimate> estimate = nullptr);

/// The distributions behind percentiles and rms values, for a part of the points; the distributions of all parts can be added.
struct MotionSizes {
    Distribution mismatch;  ///< [mm/s]
    Distribution jerk;      ///< [mm/s³]

    void add(const MotionSizes& other) {
        mismatch.add(other.mismatch);
        jerk.add(other.jerk);
    }
};

/// For points that begin and end at pass boundaries. Derivatives are window-based. O(points among `points`), parallel.
[[nodiscard]] MotionSizes motion_sizes(const Log& log, const Trajectory& path, const ClSurface& surface,
                                       const Signals& signals, const PointRange& points);

/// The quality of the whole run from the distributions of all its points: percentiles within Distribution::quantile_error,
/// all other values exact. O(standstill before and after the motion).
[[nodiscard]] MotionQuality motion_quality(const MotionSizes& sizes, const ClSurface& surface, double period);

}  // namespace clsurf

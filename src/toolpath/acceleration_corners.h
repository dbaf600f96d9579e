#pragma once
// At a jump of an axis' acceleration, a smoother that expects a steady motion is wrong for some records on both sides, by
// much more than its standard deviation: most controls without a jerk limit move like that. The error follows from the size
// of the jump alone, and the size from the innovations after it (Willsky and Jones 1976, "A generalized likelihood ratio
// approach to the detection and estimation of jumps"). Standard deviations are increased by the errors at jumps.

#include <array>
#include <span>
#include <vector>

#include "core/point.h"
#include "numeric/kalman_smoother.h"

namespace clsurf {

/// Factors of the variances of position, speed, acceleration and jerk, at least 1, one per point each.
using Inflation = std::array<std::vector<double>, 4>;

class AccelerationCorners {
public:
    /// `smoother` gives the innovations; `speeds`, if there is another one, the estimates of the speed. The constructor
    /// computes their response to a jump. O(reach).
    explicit AccelerationCorners(const KalmanSmoother& smoother, const KalmanSmoother* speeds = nullptr);

    /// Raises factors of points from `first` on. `innovations` begin at point `from`. O(innovations), and the reach for each
    /// jump.
    void raise(std::span<const Eigen::Array4d> innovations, PointIndex from, PointIndex first,
               Inflation& inflation) const;

private:
    std::vector<double> innovation_;             ///< after a jump of 1 mm/s², in standard deviations
    std::array<std::vector<double>, 4> errors_;  ///< errors around it, likewise; the jump is in the middle
    PointIndex step_ = 1;                        ///< records between tested positions of a jump
};

}  // namespace clsurf

#pragma once
// Where the acceleration of an axis jumps, a smoother that expects a steady motion is wrong for some records on both sides, by
// much more than it knows: most controls without a jerk limit move like that. How wrong it is follows from the size of the
// jump alone, and the size from the innovations after it (Willsky and Jones 1976, "A generalized likelihood ratio approach to
// the detection and estimation of jumps"). Standard deviations grow with the errors that the jumps make.

#include <array>
#include <span>
#include <vector>

#include "core/point.h"
#include "numeric/kalman_smoother.h"

namespace clsurf {

/// Factors of the variances of position, speed, acceleration and jerk, one a point each, from 1.
using Inflation = std::array<std::vector<double>, 4>;

class AccelerationCorners {
public:
    /// `smoother` gives the innovations; `speeds`, if there is another one, the estimates of the speed. What they do at a jump
    /// is computed here. O(reach).
    explicit AccelerationCorners(const KalmanSmoother& smoother, const KalmanSmoother* speeds = nullptr);

    /// Raises factors of points from `first` on. `innovations` begin at point `from`. O(innovations), and the reach for each jump.
    void raise(std::span<const Eigen::Array4d> innovations, PointIndex from, PointIndex first,
               Inflation& inflation) const;

private:
    std::vector<double> innovation_;             ///< after a jump of 1 mm/s², in standard deviations
    std::array<std::vector<double>, 4> errors_;  ///< around it, in standard deviations; the jump is in the middle
    PointIndex step_ = 1;                        ///< records from one place that is tried to the next
};

}  // namespace clsurf

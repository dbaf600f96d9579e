#pragma once
// PathCurvature: the curvature of a logged path from its geometry. |v × a|/|v|³ is meaningless if the tool hardly moves: at
// the ends of passes the errors of speed and acceleration are divided by the cube of a speed near 0. Here points that are too
// near to each other are skipped, and a parabola over the arc length is fitted to the shortest section that resolves the
// curvature (numeric/resolved_curvature.h).

#include <span>
#include <vector>

#include "core/point.h"
#include "log/log.h"
#include "toolpath/trajectory.h"

namespace clsurf {

class PathCurvature {
public:
    /// Points on each side of the requested ones up to which a section may extend.
    static constexpr PointIndex reach = 4096;

    /// Measures the errors of positions by rounding and noise. O(points), from a few sections all over the log.
    PathCurvature(const Log& log, const Trajectory& path);

    /// Curvature at points [first, first + out.size()) [1/mm], by the path before and after them, across pass limits.
    /// NaN if the path turns back, in corners of more than 45 deg within 0.2 mm, and if positions do not resolve it.
    void compute(PointIndex first, std::span<double> out) const;
    /// The effective step of positions from rounding and noise [mm].
    [[nodiscard]] double step() const { return step_; }

private:
    Trajectory path_;
    double step_ = 0;
};

}  // namespace clsurf

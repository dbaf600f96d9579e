#pragma once
// PathCurvature: the curvature of a logged path from its geometry. |v × a|/|v|³ has no meaning where the tool hardly moves: at the ends
// of passes the errors of speed and acceleration are divided by the cube of a speed near 0. Here points that are too near to
// each other are passed over, and a parabola over the arc length is fitted to as short a section as resolves the curvature
// (numeric/resolved_curvature.h).

#include <span>
#include <vector>

#include "core/point.h"
#include "log/log.h"
#include "toolpath/trajectory.h"

namespace clsurf {

class PathCurvature {
public:
    /// Points on each side of those asked for that a section may reach to.
    static constexpr PointIndex reach = 4096;

    /// Measures how far positions are off by rounding and noise. O(points), from a few sections all over the log.
    PathCurvature(const Log& log, const Trajectory& path);

    /// Of points [first, first + out.size()) [1/mm], by the path before and behind them, whatever pass that belongs to: NaN where the path turns back, in corners, which
    /// turn by more than 45 deg within 0.2 mm, and where positions do not resolve it.
    void compute(PointIndex first, std::span<double> out) const;
    /// How far apart positions are that rounding or noise cannot make [mm].
    [[nodiscard]] double step() const { return step_; }

private:
    Trajectory path_;
    double step_ = 0;
};

}  // namespace clsurf

#pragma once
// Start poses for a fit to a surface with scallops: the best ones of a grid of shifts over the surface, with height and tilt
// fitted at each.

#include <span>
#include <vector>

#include "measured/pose_fit.h"

namespace clsurf {

class PoseSearch {
public:
    /// `points` [mm]: in the axes of the measurement. `axes`: the directions of these axes on the part, along which poses are
    /// shifted. All must outlive it.
    PoseSearch(std::span<const Vec3> points, PredictedHeights& heights, const Eigen::Matrix3d& axes,
               const FreeAxes& free)
        : points_(points), heights_(heights), axes_(axes), free_(free) {}

    /// Local minima over a grid around a pose, `steps` of `step` [mm] to each side along the free ones of x and y: of the mean
    /// square of all points, and of the mean square of the nearest four fifths, which a missing mark does not affect. Returns
    /// the best of
    /// both, at most six each. O(grid · points).
    [[nodiscard]] std::vector<Pose> around(const Pose& middle, double step, std::int64_t steps);

private:
    /// Mean squares [mm²]; infinite: too few points are over the surface.
    struct Squares {
        double all = infinite_square, nearest = infinite_square;
    };
    static constexpr double infinite_square = 1e300;

    [[nodiscard]] Squares levelled(const Pose& pose) const;
    [[nodiscard]] bool is_free(PoseAxis axis) const { return free_[static_cast<std::size_t>(axis)]; }

    std::span<const Vec3> points_;
    PredictedHeights& heights_;
    const Eigen::Matrix3d& axes_;
    const FreeAxes& free_;
};

}  // namespace clsurf

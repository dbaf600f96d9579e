#pragma once
// Positions: a trajectory gathered once into floats relative to an origin, for algorithms that read a point and its
// neighbours repeatedly (passes, adjacency, drawing). Rounding is 2^-24 of the part's size, 0.1 µm on 1.5 m; heights
// in micrometres are taken from the log itself, not from here.

#include <cmath>

#include "core/block_fill.h"
#include "core/column.h"
#include "core/geometry.h"
#include "core/point.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct Positions {
    Vec3 origin = Vec3::Zero();  ///< [mm]
    Column<float> x, y, z;       ///< [mm] relative to origin; NaN: no position
    /// Set if positions are gathered on reading, else empty. Code that reads the columns directly must request its
    /// points first.
    BlockFillPointer fill;
    Column<double> arc_lengths;  ///< with `fill`: as in ArcLength::sums()

    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(x.size()); }
    /// If positions are gathered on reading: frees them until they are needed again. No thread may be reading.
    void forget();
    [[nodiscard]] Eigen::Vector3f operator[](PointIndex i) const {
        fill.need(i);
        const auto at = static_cast<std::size_t>(i);
        return {x[at], y[at], z[at]};
    }
    /// [mm], not relative to the origin.
    [[nodiscard]] Vec3 absolute(PointIndex i) const { return (*this)[i].cast<double>() + origin; }
};

/// A trajectory on these positions, all of which are gathered. They must outlive it.
[[nodiscard]] Trajectory trajectory_of(const Positions& positions);

/// Gathers all points; the origin is the trajectory's first finite point. O(points), parallel.
[[nodiscard]] Positions gather(const Trajectory& trajectory);

/// The same, but a block is gathered when it is first read. `origin` and `arc_lengths` are those of the whole log. `block`: a
/// power of two from 1024 on, which fills pages; small ones take less memory if the points that are read are far apart.
/// Columns that are filled from these positions have the same blocks.
[[nodiscard]] Positions gather_when_read(const Trajectory& trajectory, const Vec3& origin, Column<double> arc_lengths,
                                         PointIndex block = block_points);

}  // namespace clsurf

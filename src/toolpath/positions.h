#pragma once
// Positions: a trajectory gathered once into floats relative to an origin, for what looks at a point
// and its neighbours again and again (passes, adjacency, drawing). Rounding is 2^-24 of the part's
// size, 0.1 µm on 1.5 m; heights in micrometres are taken from the log itself, not from here.

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
    /// Of positions that are gathered when they are read; elsewhere nothing. Who reads columns needs them first.
    BlockFillPointer fill;
    Column<double> arc_lengths;  ///< with `fill`: as ArcLength::sums() has them

    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(x.size()); }
    /// Of positions that are gathered when they are read: they take no memory until they are asked for again. Nobody may be
    /// reading.
    void forget();
    [[nodiscard]] Eigen::Vector3f operator[](PointIndex i) const {
        fill.need(i);
        const auto at = static_cast<std::size_t>(i);
        return {x[at], y[at], z[at]};
    }
    /// [mm], not relative to the origin.
    [[nodiscard]] Vec3 absolute(PointIndex i) const { return (*this)[i].cast<double>() + origin; }
};

/// Gathers all points; the origin is the trajectory's first finite point. O(points), parallel.
[[nodiscard]] Positions gather(const Trajectory& trajectory);

/// The same, but a block is gathered when it is first read. `origin` and `arc_lengths` are those of the whole log. `block`: a power of
/// two from 1024 on, which fills pages; small ones take less memory where points are looked at that are far from each other.
/// Columns that are filled from these positions have the same blocks.
[[nodiscard]] Positions gather_when_read(const Trajectory& trajectory, const Vec3& origin, Column<double> arc_lengths,
                                         PointIndex block = block_points);

}  // namespace clsurf

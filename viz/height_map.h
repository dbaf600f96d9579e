#pragma once
// HeightMap: the heights of a surface over a grid in x and y as a mesh, for quantities that do not belong to points of the log.

#include <span>

#include "core/column.h"
#include "core/geometry.h"
#include "viz/detail.h"

namespace clsurf::viz {

struct HeightMap {
    Vec3 origin = Vec3::Zero();  ///< [mm] x and y of the first vertex, and the origin of all heights
    double pitch = 0;            ///< [mm] distance between vertices
    std::int64_t columns = 0, rows = 0;
    Column<float> z;  ///< [mm] row by row; NaN: no vertex

    [[nodiscard]] Vec3 at(std::int64_t i) const {
        const std::int64_t row = i / columns;
        return origin + Vec3(pitch * static_cast<double>(i - row * columns), pitch * static_cast<double>(row),
                             z[static_cast<std::size_t>(i)]);
    }
};

/// Extent along the axes of a view [mm]. O(vertices).
[[nodiscard]] Box3 extent_of(const HeightMap& map, const Eigen::Matrix3d& axes);

/// Its triangles with `values` per vertex, with lighting. Vertices without a height or outside
/// the request's box are omitted. O(vertices).
[[nodiscard]] Detail height_map_detail(const HeightMap& map, std::span<const float> values,
                                       const DetailRequest& request);

}  // namespace clsurf::viz

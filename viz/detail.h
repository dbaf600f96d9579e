#pragma once
// Detail: a CL surface, a projection and a picture's size → the triangles, lines and dots that pixels
// can show. Points of a pass that fall on the same part of a pixel become one vertex, whose value is
// their mean, which is what drawing all of them would have shown; between adjacent passes the
// vertices are joined by a band of triangles that leaves no vertex out, so that no cracks open. Seams
// close what bands leave: turns, pass ends, corners, where a loop begins. A missing pass stays open.

#include <cstdint>
#include <limits>
#include <span>

#include "surface/cl_surface.h"
#include "viz/geometry.h"

namespace clsurf::viz {

enum class Style : std::uint8_t { surface, lines, points };

/// Where a position [mm] lands in the picture [px from its lower left corner]: a parallel projection.
using Projection = Eigen::Matrix<double, 2, 4>;

struct DetailRequest {
    Projection projection;
    int width = 0, height = 0;  ///< [px]; what lies outside is left out
    double vertex_step = 0.7;   ///< [px] from one vertex of a pass to the next
    Style style = Style::surface;
    Box3 box;  ///< [mm]; empty: no box, else what lies outside is left out
    /// Cells are those that are made at vertices of these points. The normals are those of all cells.
    PointRange own{0, std::numeric_limits<PointIndex>::max()};
};

struct Detail {
    Geometry geometry;          ///< without colours; paint() them
    Column<float> values;       ///< per vertex, the mean over its points; NaN: no value
    Column<PointIndex> points;  ///< per vertex, the point in its middle
};

/// `values`: one per point of the surface. O(points), parallel.
[[nodiscard]] Detail visible_detail(const ClSurface& surface, std::span<const float> values,
                                    const DetailRequest& request);

}  // namespace clsurf::viz

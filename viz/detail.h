#pragma once
// Detail: a CL surface, a projection and a picture's size → the triangles, lines and dots that pixels
// can show. Points of a pass on the same part of a pixel become one vertex, whose value is
// their mean: the same result as drawing all of them. Between adjacent passes the
// vertices are joined by a band of triangles that uses every vertex, so that there are no cracks. Seams
// close the gaps of bands: turns, pass ends, corners, the start of a loop. The gap of a missing pass stays open.

#include <cstdint>
#include <limits>
#include <span>

#include "surface/cl_surface.h"
#include "viz/geometry.h"

namespace clsurf::viz {

enum class Style : std::uint8_t { surface, lines, points };

/// The position [px from the lower left corner] of a point [mm] in the picture: a parallel projection.
using Projection = Eigen::Matrix<double, 2, 4>;

struct DetailRequest {
    Projection projection;
    int width = 0, height = 0;  ///< [px]; everything outside is omitted
    double vertex_step = 0.7;   ///< [px] distance from one vertex of a pass to the next
    Style style = Style::surface;
    Box3 box;  ///< [mm] everything outside is omitted; empty: no box
    /// Cells are only made at vertices of these points. Normals take all cells into account.
    PointRange own{0, std::numeric_limits<PointIndex>::max()};
};

struct Detail {
    Geometry geometry;          ///< without colours
    Column<float> values;       ///< per vertex, the mean over its points; NaN: no value
    Column<PointIndex> points;  ///< per vertex, the point in its middle
};

/// `values`: one per point of the surface. O(points), parallel.
[[nodiscard]] Detail visible_detail(const ClSurface& surface, std::span<const float> values,
                                    const DetailRequest& request);

}  // namespace clsurf::viz

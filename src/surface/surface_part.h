#pragma once
// SurfacePart: the passes of a shard with their adjacent passes, as a separate surface with few points.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

struct SurfacePart {
    ClSurface surface;               ///< passes that are not consecutive are separated by a point without a position
    Column<PointIndex> points;       ///< of the whole surface, by point, ascending; −1: no position
    std::vector<PointRange> ranges;  ///< ranges of the whole surface that are in the part
    PointRange own;                  ///< the points of the part that it was made for
};

/// The points `own`, which begin and end at pass limits, with some passes before and after them, and on either side the
/// adjacent passes, as far as a seam of the drawn surface needs them. O(points of these passes).
[[nodiscard]] SurfacePart part_with_neighbours(const ClSurface& surface, const PointRange& own);

}  // namespace clsurf

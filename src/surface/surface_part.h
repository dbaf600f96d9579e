#pragma once
// SurfacePart: the passes of a shard with the passes beside them, as a surface of their own with few points.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

struct SurfacePart {
    ClSurface surface;          ///< its passes that do not follow each other are held apart by a point that is nowhere
    Column<PointIndex> points;  ///< of the whole surface, by point, rising; −1: nowhere
    std::vector<PointRange> ranges;  ///< of the whole surface that are in it
    PointRange own;                  ///< points of the part that it was made for
};

/// The points `own`, which begin and end where passes do, with some passes before and after them, and on either side the
/// passes beside them, as far as a seam of the drawn surface looks. O(points of these passes).
[[nodiscard]] SurfacePart part_with_neighbours(const ClSurface& surface, const PointRange& own);

}  // namespace clsurf

#pragma once
// The box that a surface fills along the axes of a view.

#include "surface/cl_surface.h"
#include "viz/view.h"

namespace clsurf::viz {

/// Extent along the axes of a view of the points that do not belong to rapids [mm]. O(points), parallel. Where the surface has
/// surface_boxes, only points that may widen the extent are read: O(blocks), and few points.
[[nodiscard]] Box3 extent_of(const ClSurface& surface, const ViewAxes& axes);

}  // namespace clsurf::viz

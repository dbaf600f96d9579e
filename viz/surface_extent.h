#pragma once
// The extent of a surface along the axes of a view.

#include "surface/cl_surface.h"
#include "viz/view.h"

namespace clsurf::viz {

/// The extent along the axes of a view of all points except rapids [mm]. O(points), parallel. If the surface has
/// surface_boxes, only points that may widen the extent are read: O(blocks), and few points.
[[nodiscard]] Box3 extent_of(const ClSurface& surface, const ViewAxes& axes);

}  // namespace clsurf::viz

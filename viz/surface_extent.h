#pragma once
// The box that a surface fills along the axes of a view.

#include <span>

#include "surface/cl_surface.h"
#include "viz/view.h"

namespace clsurf::viz {

/// Extent along the axes of a view of the points that do not belong to rapids [mm]. O(points), parallel.
[[nodiscard]] Box3 extent_of(const ClSurface& surface, const ViewAxes& axes);
/// The same of some passes of a surface.
[[nodiscard]] Box3 extent_of(const Positions& positions, std::span<const Pass> passes, const ViewAxes& axes);

}  // namespace clsurf::viz

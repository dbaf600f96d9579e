#pragma once
// Gaps left by a missing pass: adjacency spans them, the surface does not.

#include "surface/cl_surface.h"

namespace clsurf {

/// Whether a pass is missing between a point and its neighbour on a side: they are much farther apart than each is from
/// its neighbour on the other side (and than a step-over), in space and in plan view. Passes that are equidistant in plan
/// are farther apart in space on steep flanks; passes that are equidistant in space are farther apart in plan on flat
/// areas. Domain: the point has that neighbour.
[[nodiscard]] bool misses_pass(const ClSurface& surface, PointIndex point, Side side);

/// Whether the surface continues from a point to a neighbour on a side.
[[nodiscard]] inline bool has_surface(const ClSurface& surface, PointIndex point, Side side) {
    return surface.neighbours.has(side, point) && !misses_pass(surface, point, side);
}

}  // namespace clsurf

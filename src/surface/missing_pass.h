#pragma once
// Gaps that a missing pass leaves: adjacency reaches over them, the surface does not.

#include "surface/cl_surface.h"

namespace clsurf {

/// Whether a pass is missing between a point and its neighbour on a side: they lie much farther apart than each from its
/// neighbour on the other side (and than a step-over), in space and seen from above. Passes even in plan are farther apart
/// in space on steep flanks, passes even in space are so in plan where it is flat. Domain: the point has that neighbour.
[[nodiscard]] bool misses_pass(const ClSurface& surface, PointIndex point, Side side);

/// Whether the surface goes on from a point to a neighbour on a side.
[[nodiscard]] inline bool has_surface(const ClSurface& surface, PointIndex point, Side side) {
    return surface.neighbours.has(side, point) && !misses_pass(surface, point, side);
}

}  // namespace clsurf

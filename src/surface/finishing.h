#pragma once
// Finishing passes: many adjacent passes, one step-over apart along the surface. Pockets, single contours,
// drilling and helical plunges are not finishing, because they have no adjacent pass to compare.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

/// By pass: true where it cuts and belongs to a group of passes that lie side by side. A group is what neighbours join:
/// two passes belong together where a good part of the shorter one has a neighbour on the other. A few passes above
/// each other are levels of a pocket or turns of a plunge; many are a wall that was finished. O(points).
[[nodiscard]] std::vector<bool> find_finishing_passes(const ClSurface& surface);

}  // namespace clsurf

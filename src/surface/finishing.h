#pragma once
// Finishing passes: many adjacent passes, one step-over apart along the surface. Pockets, single contours,
// drilling and helical plunges are not finishing, because they have no adjacent pass to compare.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

/// By pass: whether it cuts and belongs to a group of adjacent passes. Two passes belong to one group if a large part
/// of the shorter one has neighbours on the other. A few passes above each other are levels of a pocket or turns of a
/// plunge; many are a finished wall. O(points).
[[nodiscard]] std::vector<bool> find_finishing_passes(const ClSurface& surface);

}  // namespace clsurf

#pragma once
// The outlines of a defect on the surface, to be drawn.

#include <functional>
#include <vector>

#include "predictor/defect.h"

namespace clsurf {

/// The border of the defect's area: open lines, their corners [mm], half way to the passes that do not
/// belong to it and across the ends of those that do; a clean pass between two of its own is inside.
/// `place_of` [mm] says where a point lies, on the part for example; empty: on the surface, with the tool tip.
/// O(points of the sections · log sections).
[[nodiscard]] std::vector<std::vector<Vec3>> outlines_of(const Defect& defect, const ClSurface& surface,
                                                         const std::function<Vec3(PointIndex)>& place_of = {});

}  // namespace clsurf

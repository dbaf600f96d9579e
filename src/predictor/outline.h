#pragma once
// The outlines of a defect on the surface, for drawing.

#include <functional>
#include <vector>

#include "predictor/defect.h"

namespace clsurf {

/// The border of the defect's area as open lines of corners [mm]. It runs half-way to the adjacent passes outside the defect,
/// and across the ends of the sections inside; a clean pass between two passes of the defect is inside. `place_of` [mm]: the
/// position of a point, for example its contact point; empty: the tool tip. O(points of the sections · log sections).
[[nodiscard]] std::vector<std::vector<Vec3>> outlines_of(const Defect& defect, const ClSurface& surface,
                                                         const std::function<Vec3(PointIndex)>& place_of = {});

}  // namespace clsurf

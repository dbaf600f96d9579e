#pragma once
// The outlines of a defect on the surface, to be drawn.

#include <vector>

#include "quality/defects.h"

namespace clsurf {

/// Closed lines, their corners [mm], one for each part of the defect that hangs together: along the outer
/// sides of the outermost runs, half a step-over off them, and over the ends of those between.
[[nodiscard]] std::vector<std::vector<Vec3>> outlines_of(const Defect& defect, const ClSurface& surface);

}  // namespace clsurf

#pragma once
// Steps of the curvature of a path, for example between a line and an arc. The curvature of rounded points is measured over
// sections (resolved_curvature.h), which smears a step over a section. The points themselves locate it more exactly: before
// and after it they are on two parabolas with a common tangent.

#include <cstddef>
#include <optional>
#include <span>

#include "core/geometry.h"

namespace clsurf {

/// The point near `boundary`, between points `first` and `last`, at which curvature steps. None, unless two parabolas
/// that meet fit the points much better than a cubic does, up to rounding. `curvature`: resolved, of each point [1/mm];
/// `step` [mm] of the coordinates. O(fitted points).
[[nodiscard]] std::optional<std::size_t> curvature_step_near(std::span<const Vec3> points,
                                                             std::span<const double> curvature, std::size_t boundary,
                                                             std::size_t first, std::size_t last, double step);

}  // namespace clsurf

#pragma once
// Where the curvature of a path steps from one value to another, as between a line and an arc. Curvature of rounded points is
// measured over sections (resolved_curvature.h), so that a step of it is smeared over a section. The points themselves
// tell its place more exactly: before and behind it they lie on two parabolas with one tangent.

#include <cstddef>
#include <optional>
#include <span>

#include "core/geometry.h"

namespace clsurf {

/// The point where curvature steps, of the points about `boundary` between points `first` and `last`; none where two
/// parabolas that meet do not fit the points, to their rounding, much better than a cubic. `curvature`: resolved, of each
/// point [1/mm]; `step` [mm] of the coordinates. O(points that a step can be told from).
[[nodiscard]] std::optional<std::size_t> curvature_step_near(std::span<const Vec3> points,
                                                             std::span<const double> curvature, std::size_t boundary,
                                                             std::size_t first, std::size_t last, double step);

}  // namespace clsurf

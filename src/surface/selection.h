#pragma once
// A part of a surface: some of its points, as all that is drawn and counted.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

/// Leaves the points of `ranges`, which rise and do not overlap: passes end where a range ends, what lies outside counts as
/// rapid, and nobody has a neighbour or a step-over move there. Point numbers stay. O(points).
void keep_points(ClSurface& surface, const std::vector<PointRange>& ranges);

/// Points that are in both. Each rises. O(ranges).
[[nodiscard]] std::vector<PointRange> intersection(const std::vector<PointRange>& a, const std::vector<PointRange>& b);

/// Points of the cut passes `first` … `last`, numbered from 1.
[[nodiscard]] std::vector<PointRange> points_of_passes(const Passes& passes, std::int64_t first, std::int64_t last);

}  // namespace clsurf

#pragma once
// A part of a surface: some of its points, to be drawn and counted alone.

#include <vector>

#include "surface/cl_surface.h"

namespace clsurf {

/// Keeps the points of `ranges`, which are ascending and disjoint: passes end at the end of a range, other points count as
/// rapid and have no neighbours or step-over moves. Point numbers stay. O(points).
void keep_points(ClSurface& surface, const std::vector<PointRange>& ranges);

/// Points that are in both. Both are ascending. O(ranges).
[[nodiscard]] std::vector<PointRange> intersection(const std::vector<PointRange>& a, const std::vector<PointRange>& b);

/// Points of the cut passes `first` … `last`, numbered from 1.
[[nodiscard]] std::vector<PointRange> points_of_passes(const Passes& passes, std::int64_t first, std::int64_t last);

}  // namespace clsurf

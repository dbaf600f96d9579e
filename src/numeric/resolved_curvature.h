#pragma once
// Curvature of a path whose coordinates are rounded. Rounding to steps of q moves points by up to q/2: three points at
// distances h then have a curvature that is wrong by 0.7 q/h² (rms), which exceeds that of most surfaces where points
// are dense. So each curvature is measured over as short a section as resolves it.

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

/// What a point gets whose curvature no section resolves.
enum class Unresolved : std::uint8_t {
    best,      ///< that of the widest section
    no_value,  ///< NaN where the standard error of that is more than half of it, and of `least`
};

/// Curvature at each point [1/mm] by a parabola fitted to the points around it, over the shortest section in which rounding
/// to `step` [mm] cannot change it by more than a tenth, or by a tenth of `least` [1/mm] if that is more. So the greatest
/// of many is right to a tenth, too. Sections end at points that a section of half the length has resolved, so that a
/// corner does not bend the lines beside it. Infinite where the path turns back. No two consecutive points are the same.
/// O(points · log(spacing)).
[[nodiscard]] std::vector<double> resolved_curvatures(std::span<const Vec3> points, double step, double least,
                                                      Unresolved unresolved = Unresolved::best);

}  // namespace clsurf

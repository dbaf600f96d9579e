#pragma once
// Curvature of a path whose coordinates are rounded. Rounding to steps of q moves points by up to q/2: three points at
// distances h then have a curvature that is wrong by 0.7 q/h² (rms), which exceeds that of most surfaces if points are
// dense. So each curvature is measured over the shortest section that resolves it.

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

/// The result for a point whose curvature no section resolves.
enum class Unresolved : std::uint8_t {
    best,      ///< the curvature of the widest section
    no_value,  ///< the same; NaN if its standard error exceeds half of it and half of `least`
};

/// Curvature at each point [1/mm] by a parabola fitted to the points around it. The section is the shortest one in which
/// rounding to `step` [mm] cannot change the curvature by more than a tenth, or by a tenth of `least` [1/mm] if that is
/// more. Thus even the greatest of many values is right to a tenth. Sections end at points that a section of half the
/// length has resolved, so that a corner does not bend the adjacent lines. Infinite if the path turns back. No two
/// consecutive points are the same. O(points · log(spacing)).
[[nodiscard]] std::vector<double> resolved_curvatures(std::span<const Vec3> points, double step, double least,
                                                      Unresolved unresolved = Unresolved::best);

}  // namespace clsurf

#pragma once
// The smoothest path inside a tube: points may leave their positions by a given distance, and the path bends as
// evenly as possible. At speed v the jerk of a bend is x‴ v³, so the sum of the squared third derivatives is
// minimised.

#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

/// Points no farther than `radii` [mm] from `places`, with a small sum of squared third divided differences over
/// `arc_lengths` [mm] (strictly increasing); a radius of 0 fixes a point. `start` is the initial guess, one point a
/// place; empty: the places. Fewer than four places: returns the start.
///
/// Alternating directions (S. Boyd et al., Foundations and Trends in Machine Learning 3 (2011) 1–122, section 3) over a
/// matrix with three diagonals to each side: 60 rounds; the last one ends inside the tube. The result is not the
/// optimum, but its speed is within some per cent of it. O(points).
[[nodiscard]] std::vector<Vec3> smoothest_in_tube(std::span<const Vec3> places, std::span<const double> arc_lengths,
                                                  std::span<const double> radii, std::span<const Vec3> start);

}  // namespace clsurf

#pragma once
// Quantities of three points and two lines: curvature, chord error, distance.

#include "core/geometry.h"

namespace clsurf {

/// Curvature of the circle through three points [1/mm]: 2 |a × b| / (|a||b||a + b|). 0 on a line, infinite if the
/// path turns back.
[[nodiscard]] double three_point_curvature(const Vec3& before, const Vec3& here, const Vec3& after);

/// How far a line of a length [mm] is from a curve through its ends: length² · curvature / 8, with the mean of the
/// curvatures at both ends [1/mm].
[[nodiscard]] double chord_error_of(double length, double curvature_before, double curvature_after);

/// The point of the line a–b nearest to p.
[[nodiscard]] Vec3 nearest_on_line(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace clsurf

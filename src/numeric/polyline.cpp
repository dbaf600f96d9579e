#include "numeric/polyline.h"

#include <algorithm>
#include <limits>

namespace clsurf {

double three_point_curvature(const Vec3& before, const Vec3& here, const Vec3& after) {
    const Vec3 a = here - before, b = after - here;
    const double sides = a.norm() * b.norm() * (a + b).norm();
    const double cross = a.cross(b).norm();
    if (a.dot(b) < 0 && !(cross > 0 && sides > 0)) return std::numeric_limits<double>::infinity();
    return sides > 0 ? 2 * cross / sides : 0;
}

double chord_error_of(double length, double curvature_before, double curvature_after) {
    return length * length * 0.5 * (curvature_before + curvature_after) / 8;
}

Vec3 nearest_on_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 chord = b - a;
    const double length = chord.squaredNorm();
    const double t = length > 0 ? std::clamp((p - a).dot(chord) / length, 0.0, 1.0) : 0.0;
    return a + t * chord;
}

}  // namespace clsurf

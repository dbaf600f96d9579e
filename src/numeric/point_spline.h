#pragma once
// Splines through points: one cubic per span, with the chord lengths as parameter, each coordinate by itself.

#include <span>
#include <vector>

#include "numeric/bezier_curve.h"

namespace clsurf {

/// The condition at an end.
struct PointSplineEnd {
    enum class Kind : unsigned char {
        free,     ///< cubic: not-a-knot (the last two spans are one cubic); Akima: his own end condition
        natural,  ///< second derivative 0
        tangent,  ///< first derivative, the unit vector `direction`
    };
    Kind kind = Kind::free;
    Vec3 direction = Vec3::Zero();
};

/// The cubic spline with continuous second derivative. Domain: at least two points, neighbours differ. O(points).
[[nodiscard]] std::vector<BezierCurve> cubic_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                                    const PointSplineEnd& end);

/// Akima's spline (J. ACM 17 (1970) 589–602) of each coordinate; the spline of whole vectors is numeric/akima.h.
/// Domain and cost as above.
[[nodiscard]] std::vector<BezierCurve> akima_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                                    const PointSplineEnd& end);

}  // namespace clsurf

#pragma once
// Splines through points, one cubic a span, over the lengths of the chords as parameter; each coordinate by itself.

#include <span>
#include <vector>

#include "numeric/bezier_curve.h"

namespace clsurf {

/// What holds at an end.
struct PointSplineEnd {
    enum class Kind : unsigned char {
        free,     ///< cubic: the span there and the next are one cubic (not-a-knot); Akima: as Akima has it
        natural,  ///< second derivative 0
        tangent,  ///< first derivative, the unit vector `direction`
    };
    Kind kind = Kind::free;
    Vec3 direction = Vec3::Zero();
};

/// The cubic spline with continuous second derivative. Domain: at least two points, neighbours apart. O(points).
[[nodiscard]] std::vector<BezierCurve> cubic_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                                    const PointSplineEnd& end);

/// Akima's (J. ACM 17 (1970) 589–602), coordinate by coordinate; the spline of whole vectors is numeric/akima.h.
/// Domain and cost as above.
[[nodiscard]] std::vector<BezierCurve> akima_spline(std::span<const Vec3> points, const PointSplineEnd& begin,
                                                    const PointSplineEnd& end);

}  // namespace clsurf

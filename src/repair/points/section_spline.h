#pragma once
// SectionSpline: a smoothed section as one cubic B-spline with continuous curvature, which has a few spans where lines
// would be many.

#include <optional>

#include "numeric/bezier_curve.h"
#include "repair/points/line_rules.h"
#include "repair/points/old_segment.h"
#include "repair/points/smooth_segment.h"

namespace clsurf {

inline constexpr double spline_knot_step = 0.001;  ///< [mm] knots are multiples of it, so that few decimals write them

/// The cubic B-spline nearest to the smooth curve in the sense of least squares over its arc length (Piegl and Tiller,
/// The NURBS Book, 1997, section 9.4.1), from the first old point to the last. All weights are 1. Spans are halved until
/// none leaves the curve by more than three times the chord error, or the old lines, or these it, by more than lines may. nullopt:
/// that takes spans shorter than the spacing of points. O(points · rounds).
[[nodiscard]] std::optional<Nurbs> section_spline(const OldSegment& old, const SmoothCurve& curve,
                                                  const LineRules& rules);

}  // namespace clsurf

#pragma once
// SectionSpline: a smoothed section as one cubic B-spline with continuous curvature, which needs a few spans instead of many
// lines.

#include <optional>

#include "numeric/bezier_curve.h"
#include "repair/points/line_rules.h"
#include "repair/points/old_segment.h"
#include "repair/points/smooth_segment.h"

namespace clsurf {

inline constexpr double spline_knot_step = 0.001;  ///< [mm] knots are multiples of it, so that few decimals suffice

/// The cubic B-spline nearest to the smooth curve by least squares over its arc length (Piegl and Tiller, The NURBS Book, 1997,
/// section 9.4.1), from the first old point to the last. All weights are 1. Spans are halved until two conditions are met: no
/// span is farther than three chord errors from the curve, and the spline and the old lines are within the tolerance of lines
/// everywhere. nullopt: this would need spans shorter than the spacing of points. O(points · rounds).
[[nodiscard]] std::optional<Nurbs> section_spline(const OldSegment& old, const SmoothCurve& curve,
                                                  const LineRules& rules);

}  // namespace clsurf

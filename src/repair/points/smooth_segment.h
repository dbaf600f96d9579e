#pragma once
// SmoothSegment: the smoothest curve along a section of a pass, at its aligned points.

#include <vector>

#include "numeric/cubic_span.h"
#include "repair/points/aligned_points.h"
#include "repair/points/line_rules.h"
#include "repair/points/old_segment.h"

namespace clsurf {

/// The curve at all aligned points of a section, with its ends as first and last point.
struct SmoothSegment {
    std::vector<double> arc_length;  ///< [mm] along the old lines
    std::vector<Vec3> places;        ///< [mm] places on the old lines at these arc lengths
    std::vector<Vec3> points;        ///< [mm] on the curve; the ends are the old ones
};

/// Akima's curve through the smoothest path in the tube around the old lines. Its knots are the aligned points and the old
/// points, where the tube is narrowest. Between them it stays inside most of the tolerance.
class SmoothCurve {
public:
    /// `old` must outlive it. O(points).
    SmoothCurve(const OldSegment& old, const std::vector<AlignedPoint>& aligned_points, const LineRules& rules);
    /// At an arc length along the old lines [mm].
    [[nodiscard]] Vec3 at(double arc_length) const;

private:
    const OldSegment& old_;
    double most_;                     ///< [mm] largest distance from the old lines
    std::vector<double> arc_length_;  ///< of its knots
    std::vector<CubicSpan> spans_;
};

/// The curve at all aligned points. O(points).
[[nodiscard]] SmoothSegment smooth(const OldSegment& old, const SmoothCurve& curve,
                                   const std::vector<AlignedPoint>& aligned_points);

}  // namespace clsurf

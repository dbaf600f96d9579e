#pragma once
// SmoothStretch: the smoothest curve along a section of a pass, at its stations.

#include <vector>

#include "numeric/cubic_span.h"
#include "repair/points/aligned_points.h"
#include "repair/points/line_rules.h"
#include "repair/points/old_segment.h"

namespace clsurf {

/// The curve at all stations of a section, with its ends as first and last point.
struct SmoothStretch {
    std::vector<double> way;   ///< [mm] along the old lines
    std::vector<Vec3> places;  ///< [mm] there on the old lines
    std::vector<Vec3> points;  ///< [mm] on the curve; the ends are the old ones
};

/// Akima's curve through the smoothest path in the tube around the old lines. Its knots are the stations and the old
/// points, where the tube is narrowest. Between them it stays inside most of the tolerance.
class SmoothCurve {
public:
    /// `old` must outlive it. O(points).
    SmoothCurve(const OldStretch& old, const std::vector<StationOfPass>& stations, const LineRules& rules);
    /// At an arc length along the old lines [mm].
    [[nodiscard]] Vec3 at(double way) const;

private:
    const OldStretch& old_;
    double most_;              ///< [mm] off the old lines
    std::vector<double> way_;  ///< of its knots
    std::vector<CubicSpan> spans_;
};

/// Such a curve at all stations. O(points).
[[nodiscard]] SmoothStretch smooth(const OldStretch& old, const std::vector<StationOfPass>& stations,
                                   const LineRules& rules);

}  // namespace clsurf

#pragma once
// LineAgreement: how well the lines of a map agree with the geometry of the program.

#include <span>

#include "mapping/line_map.h"

namespace clsurf {

/// How well the lines of a map agree with the geometry of the program.
struct LineAgreement {
    PointIndex checked = 0;      ///< moving points with a line
    PointIndex disagreeing = 0;  ///< farther than `tolerance` from the allowed motions of their line
    double median_distance = 0;  ///< [mm] over the checked points
    double p95_distance = 0;     ///< [mm]
    double tolerance = 0;        ///< [mm]
    PointIndex worst = -1;
    double worst_distance = 0;  ///< [mm]
};

/// Checks a map against the geometry on about 10^5 points in evenly spaced sections. A point may be on the motions from
/// its previous distinct line to its line, and one more on each side: a kernel changes the number at the beginning of a
/// blend, and reports the last line of those that it merged. Returns to the point of continuation belong to no line.
[[nodiscard]] LineAgreement check_lines(const Trajectory& path, const Program& program, const LineMap& map);

/// Confidence in the lines of points [begin, begin + out.size()), 0 … 1: as confidence_at(), and less if a point is
/// off the allowed motions of its line by more than a finishing tolerance. O(points).
void read_confidences(const Trajectory& path, const Program& program, const LineMap& map, PointIndex begin,
                      std::span<double> out);

}  // namespace clsurf

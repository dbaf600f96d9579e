#pragma once
// LineAgreement: how well the lines of a map and the geometry of the program fit.

#include <span>

#include "mapping/line_map.h"

namespace clsurf {

/// How well the lines of a map and the geometry of the program fit.
struct LineAgreement {
    PointIndex checked = 0;      ///< moving points with a line
    PointIndex disagreeing = 0;  ///< farther than `tolerance` from what their line allows
    double median_distance = 0;  ///< [mm] over the checked points
    double p95_distance = 0;     ///< [mm]
    double tolerance = 0;        ///< [mm]
    PointIndex worst = -1;
    double worst_distance = 0;  ///< [mm]
};

/// Checks a map against the geometry on about 10^5 points in evenly spaced sections. A point may
/// lie on the motions from its previous distinct line to its line, one more on each side: a kernel
/// changes the number where a blend begins, and reports the last line of those that it merged. Ways back to where a run
/// goes on belong to no line.
[[nodiscard]] LineAgreement check_lines(const Trajectory& path, const Program& program, const LineMap& map);

/// How sure the lines of points [begin, begin + out.size()) are, 0 … 1: as confidence_at() has it, and less where a
/// point is off what its line allows by more than a finishing tolerance. O(points).
void read_confidences(const Trajectory& path, const Program& program, const LineMap& map, PointIndex begin,
                      std::span<double> out);

}  // namespace clsurf

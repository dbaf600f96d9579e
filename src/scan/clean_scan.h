#pragma once
// Preparation of a scan for fitting: outliers are rejected, and repeated measurements of one place are combined.
//
// A point is an outlier if it is far from the running median of nine places (its own and the next four on each
// side) along the median slope of the nine (Siegel 1982). At the ends these are the first and the last nine.
// Up to three consecutive places may be wrong: of eight slopes to others, five are right. The height of a place is the
// median of all points there.

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct ScanPoint {
    double x = 0, z = 0;  ///< [mm]
};

struct CleanScan {
    std::vector<double> x, z;         ///< [mm] of the accepted points, x strictly increasing
    std::vector<ScanPoint> rejected;  ///< in ascending x
    std::size_t averaged = 0;         ///< points that were averaged with another one of the same x
    double scatter = 0;  ///< [mm] standard deviation about the running median, from the median absolute one
};

/// `points` in ascending x. `threshold`: multiples of the scatter of the whole scan or of the 21 places around,
/// whichever is greater, so that a tight curve is not an outlier; 0: no point is rejected. O(points).
[[nodiscard]] CleanScan clean_scan(std::span<const ScanPoint> points, double threshold);

}  // namespace clsurf

#pragma once
// A scan that can be fitted: outliers rejected, places that were scanned more than once made one.
//
// A point is an outlier where it lies far from the running median of nine places, which are the four next ones on each
// side and its own, along the median slope of the nine (Siegel 1982). At the ends they are the first and the last nine.
// Up to three places in a row may be wrong: of eight slopes to others, five are right. The height of a place is the median
// of all points there.

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

struct ScanPoint {
    double x = 0, z = 0;  ///< [mm]
};

struct CleanScan {
    std::vector<double> x, z;         ///< [mm] of the points that are kept, x rising strictly
    std::vector<ScanPoint> rejected;  ///< in rising x
    std::size_t averaged = 0;         ///< points that were averaged with another one of the same x
    double scatter = 0;  ///< [mm] standard deviation about the running median, from the median absolute one
};

/// `points` in rising x. `threshold`: multiples of the scatter, that of the whole scan or that of the 21 places around,
/// whichever is greater, so that a tight curve is no outlier; 0: none is rejected. O(points).
[[nodiscard]] CleanScan clean_scan(std::span<const ScanPoint> points, double threshold);

}  // namespace clsurf

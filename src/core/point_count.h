#pragma once
// Number of points in a given time. Bounded, because the period of a log may be wrong.

#include <algorithm>
#include <cmath>

#include "core/point.h"

namespace clsurf {

/// Number of points in `seconds` at this period [s], rounded: from `least` to a million.
[[nodiscard]] inline PointIndex points_in(double seconds, double period, PointIndex least = 1) {
    return std::max<PointIndex>(least, std::lround(std::min(seconds / period, 1e6)));
}

/// The same for a window with a point in its middle: odd, at most 2,001.
[[nodiscard]] inline int window_points(double seconds, double period, int least = 1) {
    return std::max(least, static_cast<int>(std::lround(std::min(seconds / period, 2000.0))) | 1);
}

}  // namespace clsurf

#pragma once
// New lines: which points of a smooth curve become the ends of lines, so that neighbour passes have theirs side by side and
// no line leaves curve or programmed path by too much.

#include <vector>

#include "optimize/smooth_stretch.h"

namespace clsurf {

/// The ends of the lines that take the place of a stretch, without its beginning; the last is the stretch's own end. Lines
/// end at every first, second, fourth … station, as the chord error allows; which, hangs on the number of the station. Where a line would
/// leave old points too far off, there are points beside those. O(points).
[[nodiscard]] std::vector<Vec3> new_lines(const OldStretch& old, const SmoothStretch& curve,
                                          const std::vector<StationOfPass>& stations, const LineRules& rules);

}  // namespace clsurf

#pragma once
// New lines: which points of a smooth curve become the ends of lines, so that neighbour passes have theirs side by side and
// no line leaves curve or programmed path by too much.

#include <vector>

#include "optimize/smooth_stretch.h"
#include "optimize/turning_stretch.h"

namespace clsurf {

/// The ends of the lines that take the place of a stretch, without its beginning; the last is the stretch's own end. Lines
/// end at every first, second, fourth … station, as the chord error allows; which, hangs on the number of the station. Where a line would
/// leave old points too far off, or turn the tool axis away, there are points beside those. `turning`: nullptr where
/// the tool axis stands. O(points).
[[nodiscard]] std::vector<NewPlace> new_lines(const OldStretch& old, const SmoothStretch& curve,
                                              const std::vector<StationOfPass>& stations, const LineRules& rules,
                                              const TurningStretch* turning);

}  // namespace clsurf

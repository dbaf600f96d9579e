#pragma once
// Position noise: what each logged position has by itself, along the feed.
//
// Positions that a controller commands follow its clock exactly. A log that a second computer takes, or one of measured
// positions, scatters along the feed: by the delay of the reading times the speed, or by what the scales resolve. Speeds and
// accelerations of such a log scatter more than the rounding of the positions explains.

#include <vector>

#include "surface/cl_surface.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Standard deviation [mm] of independent errors of the positions along the feed, from fourth differences of five
/// records each, at most 20,000 times. The calm quarter of them counts: a tool that starts, stops or turns has fourth
/// differences of its own. 0 where the log is too short. O(1).
[[nodiscard]] double position_noise(const Trajectory& path, const std::vector<PointRange>& pieces);

}  // namespace clsurf

#pragma once
// Position noise: the error of each logged position along the feed.
//
// Positions that a controller commands follow its clock exactly. A log of measured positions, or one that a second computer
// takes, scatters along the feed: by the resolution of the scales, or by the jitter of the reading times multiplied by the
// speed. Speeds and accelerations of such a log scatter more than the rounding of the positions explains.

#include <vector>

#include "surface/cl_surface.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Standard deviation [mm] of independent errors of the positions along the feed, from fourth differences of five records each,
/// at most 20,000 of them. Only the calmest quarter counts, because a tool that starts, stops or turns has fourth differences
/// that are not noise. 0 if the log is too short. O(1).
[[nodiscard]] double position_noise(const Trajectory& path, const std::vector<PointRange>& pieces);

}  // namespace clsurf

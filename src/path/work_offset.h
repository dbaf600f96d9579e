#pragma once
// The work offset of a log that does not tell it: the one translation that lays the positions onto
// the programmed path.
//
// First guesses come from the places where the reported line changes (the end of a programmed line)
// or, without lines, from the corners of the two bounding boxes; a log may reach farther than its
// program on one side of an axis. Each guess is refined by robust least squares of the distances to
// the nearest motions, along whose direction nothing is learned (iterative closest point with
// translation only: Chen, Medioni 1992).

#include <optional>

#include "path/line_map.h"

namespace clsurf {

/// What must be added to the positions [mm], where exactly one translation brings at least 90 % of
/// the sampled moving points within 0.05 mm of the path. None for a path that does not determine it
/// (one straight line; half a raster without lines, which fits at either end). `map`: lines of the
/// log where it reports them, nullptr without. O(records + motions), some seconds at 10^7.
[[nodiscard]] std::optional<Vec3> find_shift(const Trajectory& path, const Program& program, const LineMap* map);

}  // namespace clsurf

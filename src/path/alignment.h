#pragma once
// Alignment of a log without line numbers and its program: points advance monotonically along the
// programmed path.
//
// For each point the foot on the path is looked for from the last foot on, in a window of way that
// the tool can have gone since (the chord between the points, more where a corner is cut). The
// nearest foot wins; among equally near ones (out and back on the same way, a path that crosses
// itself) the one whose way fits the chord. Where the foot stays far away the walk is lost and
// starts again at the best place of the program, forward first, found by a grid over the motions.

#include "core/diagnostic.h"
#include "path/line_map.h"

namespace clsurf {

/// Lines and confidences for every point. O(points + motions). Adds `map.lost`, `map.far`.
[[nodiscard]] LineMap align_lines(const Trajectory& path, const Program& program, Diagnostics& diagnostics);

}  // namespace clsurf

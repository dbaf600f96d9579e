#pragma once
// Alignment of a log without line numbers with its program: points advance monotonically along the programmed
// path.
//
// Each point is projected onto the path. The search starts from the last projection and covers the arc length
// that the tool can have travelled since (the chord between the points, more if a corner is cut). The nearest
// projection wins. Among equally near ones (back and forth on the same line, a path that crosses itself), the
// one whose arc length fits the chord wins. If the projection stays far away, the alignment is lost and starts
// again at the best place of the program, forward first, found by a grid over the motions.

#include "core/diagnostic.h"
#include "mapping/line_map.h"

namespace clsurf {

/// Lines and confidences for every point. O(points + motions). Adds `map.lost`, `map.far`.
[[nodiscard]] LineMap align_lines(const Trajectory& path, const Program& program, Diagnostics& diagnostics);

}  // namespace clsurf

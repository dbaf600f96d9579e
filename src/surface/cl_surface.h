#pragma once
// ClSurface: the tool's path put back together as a surface of cutter-location points: passes, and
// for each point its neighbours on both adjacent passes. The mesh that is drawn, the mismatch that
// is measured and the normal that turns a lag into a depth all come from it.

#include <vector>

#include "path/passes.h"
#include "path/positions.h"
#include "surface/adjacency.h"

namespace clsurf {

struct ClSurface {
    Positions positions;
    Passes passes;         ///< by turns back and by returning to themselves (a turn of a spiral is one)
    std::vector<PointRange> jogs;  ///< steps sideways from one closed loop to the next, in order
    Adjacency neighbours;
    double step_over = 0;  ///< [mm]; 0: a single pass, no neighbours
};

/// Stitches the runs of a trajectory into a surface. `step_over` [mm], 0: estimated. O(points).
[[nodiscard]] ClSurface stitch(Positions positions, const LineMap& lines, double step_over = 0);

}  // namespace clsurf

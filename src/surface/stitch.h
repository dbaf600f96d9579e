#pragma once
// stitch(): the CL surface of a trajectory: its passes, their neighbours, the step-over.

#include "mapping/line_map.h"
#include "surface/cl_surface.h"

namespace clsurf {

/// Stitches the runs of a trajectory into a surface; what is no finishing pass is left out. `step_over` [mm], 0: estimated. O(points).
[[nodiscard]] ClSurface stitch(Positions positions, const LineMap& lines, double step_over = 0);

/// For pictures: where finishing passes are less than a tenth of the cutting, a picture of them shows next to nothing. All cutting
/// becomes passes then, without neighbours. Elsewhere the surface stays as it is. O(points).
void show_all_cutting(ClSurface& surface);

}  // namespace clsurf

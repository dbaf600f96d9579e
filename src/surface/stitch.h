#pragma once
// stitch(): the CL surface of a trajectory: its passes, their neighbours, the step-over.

#include "mapping/line_map.h"
#include "surface/cl_surface.h"

namespace clsurf {

/// Stitches the runs of a trajectory into a surface of its finishing passes. `step_over` [mm], 0: estimated. O(points).
[[nodiscard]] ClSurface stitch(Positions positions, const LineMap& lines, double step_over = 0);

/// For pictures: if finishing passes are less than a tenth of the cutting, a picture of them shows next to nothing. Then all
/// cutting becomes passes, without neighbours. Else the surface is unchanged. O(points).
void show_all_cutting(ClSurface& surface);

}  // namespace clsurf

#pragma once
// ScallopMap: the height of the cusps that a ball leaves beside each point of a tool path, from the path alone: feed
// direction, normals and contact points follow from a point and its neighbours. What the machine does is not in it.

#include "core/column.h"
#include "machined/tool.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct ScallopMap {
    Column<float> height;  ///< [mm] per point, the higher one of both sides; uncut: the radius; NaN: no adjacent pass
    /// [mm] Not exceeded on that share of the cut path that has a height; NaN: none has one.
    double median = 0, p95 = 0, most = 0;
    double uncut =
        0;  ///< [mm²] between adjacent passes that are farther apart than the tool is wide: it stands as it was
};

/// Of passes that cut; points are as close as those of a log or of a programmed surface. Throws UsageError: no ball.
/// O(points log points), parallel.
[[nodiscard]] ScallopMap scallop_map(const ClSurface& surface, const CuttingTool& tool);

}  // namespace clsurf

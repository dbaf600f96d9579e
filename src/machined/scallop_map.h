#pragma once
// ScallopMap: the height of the cusps that a ball leaves next to each point of a tool path. It is computed from the path alone:
// feed direction, normals and contact points follow from a point and its neighbours. Effects of the machine are not included.

#include "core/column.h"
#include "machined/tool.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct ScallopMap {
    Column<float> height;  ///< [mm] per point, the higher one of both sides; uncut: the radius; NaN: no adjacent pass
    /// [mm] Quantiles over the cut path with a known height; NaN: no height is known.
    double median = 0, p95 = 0, most = 0;
    double uncut = 0;  ///< [mm²] area left uncut, because adjacent passes are farther apart than the tool diameter
};

/// The map of passes that cut. Points must be as close as those of a log or of a programmed surface. Throws UsageError: the
/// tool is not a ball.
/// O(points log points), parallel.
[[nodiscard]] ScallopMap scallop_map(const ClSurface& surface, const CuttingTool& tool);

}  // namespace clsurf

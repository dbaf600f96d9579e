#pragma once
// Kept points: the points of a log that a page contains. If they do not all fit, the path is divided into windows
// of equal point count. Each window keeps its first point and the points with the lowest and highest value of each field,
// so that a curve shows every extreme of the window. Independent of the windows, these are kept: the ends of passes, the
// first point of each line, every point of a defect and of the adjacent passes, and the points with the lowest and highest
// value of each field and position overall. Defects that would need more than a quarter of the limit, and
// line starts that would need half of it, are only kept by windows.

#include <span>

#include "field/field.h"
#include "mapping/line_map.h"
#include "predictor/defects.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct KeptPoints {
    Column<PointIndex> points;                   ///< increasing; only points with a position
    PointIndex all = 0;                          ///< points with a position
    PointIndex window = 1;                       ///< points; 1: all are kept
    bool line_starts = true;                     ///< the first point of each line is kept
    std::size_t defects = 0, whole_defects = 0;  ///< number of all defects, and of those kept with all points

    [[nodiscard]] bool reduced() const { return window > 1; }
};

/// At most about `most` points, as long as the ends of passes and of defects allow it. `defects`: earlier ones are kept
/// completely first. `fields`: one value per point each. O(points · fields · log windows), parallel; the same for any number
/// of threads.
[[nodiscard]] KeptPoints keep_points(const ClSurface& surface, const LineMap& lines, std::span<const Field> fields,
                                     std::span<const Defect> defects, PointIndex most);

}  // namespace clsurf

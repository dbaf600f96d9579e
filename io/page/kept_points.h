#pragma once
// Kept points: the points of a log that a page gets. If they do not all fit, the path is divided into windows
// of equal point count. Each window keeps its first point and the points where a field is lowest and highest,
// so that a curve shows every extreme of the window. Also kept, whatever the windows: the ends of passes, the
// first point of each line, every point of a defect and of the adjacent passes, and the points where a field
// or position is lowest or highest overall. Defects that would need more than a quarter of the room, and
// starts of lines that would need half of it, only get their windows, which keep their extremes.

#include <span>

#include "field/field.h"
#include "mapping/line_map.h"
#include "predictor/defects.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct KeptPoints {
    Column<PointIndex> points;                   ///< rising; points without a position are never among them
    PointIndex all = 0;                          ///< with a position
    PointIndex window = 1;                       ///< points; 1: all are kept
    bool line_starts = true;                     ///< the first point of each line is among them
    std::size_t defects = 0, whole_defects = 0;  ///< and those of which all points are among them

    [[nodiscard]] bool reduced() const { return window > 1; }
};

/// At most about `most` points, as long as the ends of passes and of defects allow it. `defects`: the first ones are kept whole
/// first. `fields`: one value per point each.
/// O(points · fields · log windows), parallel; the same for any number of threads.
[[nodiscard]] KeptPoints keep_points(const ClSurface& surface, const LineMap& lines, std::span<const Field> fields,
                                     std::span<const Defect> defects, PointIndex most);

}  // namespace clsurf

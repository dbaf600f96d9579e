#pragma once
// Kept points: which points of a log a page is sent. All of them where they fit; else the way is cut
// into windows of so many points, and of each window stay its first point and where a field is
// lowest and highest in it, so that a curve drawn from them shows every extreme of the window.
// Whatever the windows: the ends of passes, the first point of each line, every point of a defect and
// of the passes beside it, and where a field or a position is lowest or highest of all. Defects that would need
// more than a quarter of the room and starts of lines that would need half of it are left to the windows, which keep their extremes.

#include <span>

#include "field/field.h"
#include "path/line_map.h"
#include "quality/defects.h"
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

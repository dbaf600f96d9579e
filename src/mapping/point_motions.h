#pragma once
// The motion of each point of a range.

#include <vector>

#include "core/block.h"
#include "mapping/line_map.h"

namespace clsurf {

/// Calls take(point, motion) for each point; motion −1: none. Parallel, in order within a block.
template <typename Take>
void for_each_motion(const LineMap& lines, PointRange points, const Take& take) {
    parallel_for(points.size(), block_points, [&](std::int64_t first, std::int64_t last) {
        std::vector<LineNumber> line(static_cast<std::size_t>(last - first));
        lines.read(points.first + first, line);
        for (std::int64_t i = first; i < last; ++i) {
            const PointIndex point = points.first + i;
            take(point, lines.motion_at(point, line[static_cast<std::size_t>(i - first)]));
        }
    });
}

}  // namespace clsurf

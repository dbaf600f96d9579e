#pragma once
// Points whose reported line the program does not have: it is a line of another program, or the program was truncated.

#include <limits>

#include "mapping/line_map.h"

namespace clsurf {

struct UnknownLines {
    PointIndex moving = 0;   ///< points that move on a line; 0 also if the program has all lines
    PointIndex unknown = 0;  ///< moving points whose line the program does not have
    PointIndex first = -1;   ///< the first of these
    LineNumber low = std::numeric_limits<LineNumber>::max(), high = 0;  ///< their lines

    [[nodiscard]] double share() const {
        return moving > 0 ? static_cast<double>(unknown) / static_cast<double>(moving) : 0.0;
    }
};

/// Points at rest do not count: a control may report any line before and after the program. A line is known if any
/// file of the program has it, because the log may count the lines of the current file. O(points).
[[nodiscard]] UnknownLines find_unknown_lines(const Trajectory& path, const Program& program, const LineMap& map);

}  // namespace clsurf

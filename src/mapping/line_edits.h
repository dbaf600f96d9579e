#pragma once
// Lines of a program that was edited after the run. The line numbers of the log belong to the old text.
// Matching the logged path with the motions of the new text gives the new line of each number.

#include <optional>
#include <string>
#include <vector>

#include "core/channel_view.h"
#include "core/column.h"
#include "mapping/line_agreement.h"
#include "mapping/line_map.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Lines inserted (by > 0) or deleted (by < 0).
struct LineShift {
    LineNumber before = 0;  ///< the first line of the old text that has moved
    std::int64_t by = 0;
};

struct LineEdits {
    std::vector<LineShift> shifts;  ///< in the order of the lines
    Column<LineNumber> lines;       ///< of the points, in the new text

    /// "1 line inserted before line 5, 3 lines deleted before line 120 and 2 more changes".
    [[nodiscard]] std::string text() const;
};

/// The share of points, 0 … 1, that are not exactly on the line that the log reports, from the middles of runs of
/// points in evenly spaced sections. Unlike check_lines() it distinguishes adjacent lines. O(1).
[[nodiscard]] double displaced_share(const Trajectory& path, const Program& program, const LineMap& map);

/// The edits that explain the differences between the reported lines and those that `aligned` found by geometry.
/// `lines`: those of the main program, one for each point. nullopt: no edits of whole lines explain them. O(points +
/// lines).
[[nodiscard]] std::optional<LineEdits> find_line_edits(const Trajectory& path, const Program& program,
                                                       const ChannelView& lines, const LineMap& aligned);

}  // namespace clsurf

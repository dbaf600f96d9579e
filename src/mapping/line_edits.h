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
    LineNumber before = 0;  ///< the first line of the old text that stands elsewhere now
    std::int64_t by = 0;
};

struct LineEdits {
    std::vector<LineShift> shifts;  ///< in the order of the lines
    Column<LineNumber> lines;       ///< of the points, in the new text

    /// "1 line inserted before line 5, 3 lines deleted before line 120 and 2 more changes".
    [[nodiscard]] std::string text() const;
};

/// Whether points lie on the very line that the log gives them, by the middles of runs of points in evenly spaced
/// sections: the share that does not, 0 … 1. Unlike check_lines() it tells a line from the next one. O(1).
[[nodiscard]] double displaced_share(const Trajectory& path, const Program& program, const LineMap& map);

/// The edits that explain how the reported lines differ from those that `aligned` found by geometry. `lines`: those
/// of the main program, one for each point. nullopt: no edits of whole lines explain it. O(points + lines).
[[nodiscard]] std::optional<LineEdits> find_line_edits(const Trajectory& path, const Program& program,
                                                       const ChannelView& lines, const LineMap& aligned);

}  // namespace clsurf

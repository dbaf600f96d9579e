#pragma once
// Shifts of the lines of a text against those that a log reports, from the times at which the tool reached the end of
// each line.

#include <cstdint>
#include <span>
#include <vector>

#include "core/column.h"
#include "program/program.h"

namespace clsurf {

/// The record at which a log stops reporting a line. Only moving records are counted.
struct LineEnd {
    LineNumber line = 0;      ///< as reported
    std::int64_t record = 0;  ///< the first one with another line
    double blend = 0;         ///< records by which a blend may advance the change
    double off_path = 0;      ///< share of its records for which geometry finds no line
};

/// Lines from `first` on, all shifted by the same number of lines.
struct ShiftedLines {
    LineNumber first = 0;  ///< as reported
    std::int64_t shift = 0;
};

struct LineShifts {
    std::vector<ShiftedLines> sections;  ///< in order; lines before the first one are not shifted
    std::int64_t lead = 0;               ///< records by which the reported lines lead the positions
    std::size_t lines = 0;               ///< number of informative lines
    double unexplained = 0;              ///< share of the lines, 0 … 1
};

/// The fewest shifts that explain the ends of the reported lines. A line is explained if it ends when the tool comes to
/// its end, within the lead and a blend. Another shift must explain several lines better to be accepted, because short
/// lines end within the lead of each other. The lead is the one that leaves the least unexplained, and the shortest
/// among equals: lines that all last as long as the lead look like shifted ones. `ends`: sorted by line. `found`: the
/// line that geometry finds for each moving record; 0: none. `with_motion`: lines of the text that move, sorted.
/// O(records + ends · nearby shifts).
[[nodiscard]] LineShifts find_line_shifts(std::span<const LineEnd> ends, const Column<LineNumber>& found,
                                          std::span<const LineNumber> with_motion);

}  // namespace clsurf

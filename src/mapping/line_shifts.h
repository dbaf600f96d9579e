#pragma once
// How the lines of a text are shifted against those that a log reports, by when the tool came to the end of each line.

#include <cstdint>
#include <span>
#include <vector>

#include "core/column.h"
#include "program/program.h"

namespace clsurf {

/// Where a log stops reporting a line. Records are counted among those that move.
struct LineEnd {
    LineNumber line = 0;      ///< as reported
    std::int64_t record = 0;  ///< the first one with another line
    double blend = 0;         ///< records by which a blend may bring the change forward
    double off_path = 0;      ///< part of its records for which geometry finds no line
};

/// Lines from one on, all shifted by the same number of lines.
struct ShiftedLines {
    LineNumber first = 0;  ///< as reported
    std::int64_t shift = 0;
};

struct LineShifts {
    std::vector<ShiftedLines> sections;  ///< in order; lines before the first one are not shifted
    std::int64_t lead = 0;               ///< records by which the reported lines lead the positions
    std::size_t lines = 0;               ///< that tell something
    double unexplained = 0;              ///< part of the lines, 0 … 1
};

/// The fewest shifts that explain the ends of the reported lines. A line that ends when the tool comes to its end, give
/// or take the lead and a blend, is explained; another shift must explain several lines better to be believed, since
/// short lines end within the lead of each other. The lead is the one that leaves least to explain, and the shortest of
/// those that do equally well: lines that all last as long as the lead look like shifted ones.
/// `ends`: sorted by line. `found`: the line that geometry finds for each record that moves; 0: none.
/// `with_motion`: lines of the text that move, sorted. O(records + ends · shifts near by).
[[nodiscard]] LineShifts find_line_shifts(std::span<const LineEnd> ends, const Column<LineNumber>& found,
                                          std::span<const LineNumber> with_motion);

}  // namespace clsurf

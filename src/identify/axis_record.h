#pragma once
// AxisRecord: the commanded and the feedback position of one axis in each period of a run.

#include <cmath>
#include <span>
#include <vector>

#include "core/channel_view.h"
#include "core/point.h"
#include "log/log.h"

namespace clsurf {

/// Whether two runs were recorded at one period. Periods of text files have rounding errors.
[[nodiscard]] inline bool same_period(double a, double b) {
    constexpr double same = 1e-6;  // relative; records drift by one period in 10^6
    return std::abs(a - b) <= same * a;
}

/// The row of a period, which is added if there is none.
template <typename Row>
[[nodiscard]] Row& row_of_period(std::vector<Row>& rows, double period) {
    for (Row& row : rows)
        if (same_period(row.period, period)) return row;
    rows.emplace_back().period = period;
    return rows.back();
}

/// Positions of one axis in one run [mm, or deg].
struct AxisRecord {
    ChannelView commanded, feedback;
    std::vector<PointRange> sections;  ///< of consecutive records, each with both positions
};

/// The longest ranges in which the time channel has no gap, `channels` have no missing value, and no value jumps farther
/// than an axis can move. All ranges have one size. O(records).
[[nodiscard]] std::vector<PointRange> find_sections(const Log& log, std::span<const ChannelView> channels);

/// Evenly spaced pieces of the sections with about `most` records in total; all records if there are fewer.
[[nodiscard]] std::vector<PointRange> sample_pieces(std::span<const PointRange> sections, PointIndex most);

}  // namespace clsurf

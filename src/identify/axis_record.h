#pragma once
// AxisRecord: the commanded and the feedback position of one axis in each period of a run.

#include <span>
#include <vector>

#include "core/channel_view.h"
#include "core/point.h"
#include "log/log.h"

namespace clsurf {

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

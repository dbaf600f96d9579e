#pragma once
// AxisRecord: what a run tells of one axis: the commanded and the fed-back position of each period.

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

/// The longest ranges without a gap in the time channel, without a missing value in `channels`, all of one size, and
/// without a jump that no axis makes.
/// O(records).
[[nodiscard]] std::vector<PointRange> find_sections(const Log& log, std::span<const ChannelView> channels);

/// Evenly spaced pieces of the sections with about `most` records together; all of them where they are fewer.
[[nodiscard]] std::vector<PointRange> sample_pieces(std::span<const PointRange> sections, PointIndex most);

}  // namespace clsurf

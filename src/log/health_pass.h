#pragma once
// The pass of check_health() over every record: each block is read once, all channels together, and gives a summary;
// summaries are joined in order.

#include <vector>

#include "log/log.h"

namespace clsurf {

/// Properties of a channel over the whole log.
struct ChannelRange {
    PointIndex missing = 0;  ///< NaN and infinite values
    PointIndex first_missing = -1;
    double low = 0, high = 0;  ///< bounds of the other values; low > high: there are none
};

struct RecordFindings {
    Diagnostics diagnostics;           ///< time, jumps, lines
    std::vector<ChannelRange> ranges;  ///< one per channel of the log; integer channels are skipped
};

/// `period` [s]: the expected step of the clock. `program_lines`: 0: unknown.
[[nodiscard]] RecordFindings check_records(const Log& log, double period, LineNumber program_lines);

}  // namespace clsurf

#pragma once
// The pass of check_health() over every record: a block is looked at once, all channels together, and
// leaves a summary; summaries are joined in order.

#include <vector>

#include "log/log.h"

namespace clsurf {

/// What a channel does over the whole log.
struct ChannelRange {
    PointIndex missing = 0;  ///< NaN and infinite values
    PointIndex first_missing = -1;
    double low = 0, high = 0;  ///< of the others; low > high: there is none
};

struct RecordFindings {
    Diagnostics diagnostics;           ///< time, jumps, lines
    std::vector<ChannelRange> ranges;  ///< one a channel of the log; whole numbers are passed over
};

/// `period` [s]: what a step of the clock should be. `program_lines`: 0: not known.
[[nodiscard]] RecordFindings check_records(const Log& log, double period, LineNumber program_lines);

}  // namespace clsurf

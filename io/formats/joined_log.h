#pragma once
// Joins a log with the channels of another one that was recorded at the same time but at a lower rate.

#include <optional>

#include "log/log.h"

namespace clsurf::io {

struct JoinRules {
    std::optional<double> offset = {};  ///< [s] in the slow log at the first record of the other; none: from `recorded`
    std::optional<double> age =
        {};  ///< [s] longest time for which a value is held; none: three periods of the slow log
};

/// Adds the channels of `slow` to `log`; each value is held until the next one (log/held_values.h). Without an offset, the
/// times `recorded` in the metadata of both logs give it. Returns the warning `join.gap` for each channel
/// with missing values. Throws UsageError (no offset and no such times), InputError (no common time, a channel in both
/// logs, no channel).
[[nodiscard]] Diagnostics join_log(Log& log, const Log& slow, const JoinRules& rules);

}  // namespace clsurf::io

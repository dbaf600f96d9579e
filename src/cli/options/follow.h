#pragma once
// --follow, --follow-timeout: follows a log that is still being written to its end.

#include <functional>
#include <optional>

#include "cli/options/part.h"
#include "io/formats/growing_log.h"
#include "io/reports/follow_report.h"

namespace clsurf::cli {

struct FollowOptions {
    double timeout = 0;  ///< [s] time without growth after which following ends; 0: no limit
};

/// `meaning`: the description of --follow.
void declare_follow(po::options_description& options, const char* meaning);
/// nullopt: the log is complete. Throws UsageError.
[[nodiscard]] std::optional<FollowOptions> read_follow(const po::variables_map& values);

/// When new records are processed.
struct LookRules {
    double least_pause = 0.1;         ///< [s] shortest pause from one call to the next
    double pause_share = 0.5;         ///< … and as a share of the duration of the previous call
    PointIndex most_unseen = 50'000;  ///< records that are processed without delay
    bool keeps_records = true;        ///< false: only the bytes of the log are needed
    bool at_end = true;               ///< the last records are processed when the log ends
};

/// Follows the log of a part to its end. Calls look(log) when there are new records, and at the end once more if some
/// were not processed. Waits for a file that does not exist yet. Ctrl-C also ends it. Returns why it ended. `bytes`: the
/// whole log. Throws InputError, UsageError: as GrowingLog; and the exceptions of `look`.
[[nodiscard]] io::FollowEnd follow_log(const PartOptions& options, const FollowOptions& follow, const LookRules& rules,
                                       const std::function<void(io::GrowingLog&)>& look, io::Source& bytes);

}  // namespace clsurf::cli

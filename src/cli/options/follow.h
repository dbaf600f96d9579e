#pragma once
// --follow, --follow-timeout: a log that is still being written, until it ends.

#include <functional>
#include <optional>

#include "cli/options/part.h"
#include "io/formats/growing_log.h"
#include "io/reports/follow_report.h"

namespace clsurf::cli {

struct FollowOptions {
    double timeout = 0;  ///< [s] without growth that end it; 0: none does
};

/// `meaning`: of --follow.
void declare_follow(po::options_description& options, const char* meaning);
/// nullopt: the log is complete. Throws UsageError.
[[nodiscard]] std::optional<FollowOptions> read_follow(const po::variables_map& values);

/// When records are looked at.
struct LookRules {
    double least_pause = 0.1;         ///< [s] from one look to the next
    double pause_share = 0.5;         ///< … and of the time that the one before took
    PointIndex most_unseen = 50'000;  ///< records, which are looked at at once
    bool keeps_records = true;        ///< false: all that is wanted are the bytes of the log
    bool at_end = true;               ///< the last records are looked at when the log ends
};

/// Follows the log of a part until it ends: calls look(log) when there are new records, and once more at the end where some
/// were not seen. A file that is not there yet is waited for. Ctrl-C ends it too. Returns why it ended. `bytes`: all of the
/// log. Throws InputError, UsageError: as GrowingLog; and what `look` throws.
[[nodiscard]] io::FollowEnd follow_log(const PartOptions& options, const FollowOptions& follow, const LookRules& rules,
                                       const std::function<void(io::GrowingLog&)>& look, io::Source& bytes);

}  // namespace clsurf::cli

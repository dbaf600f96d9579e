#pragma once
// `render --follow`, `report --follow`: an output that is rewritten while the log is written.

#include <functional>
#include <string>

#include "cli/options/follow.h"

namespace clsurf::cli {

/// Rewrites `output` from the complete records so far, with pauses of at least 2 s and twice the duration of one update, and
/// at the end from the complete log. make(last) reads part.log_source and replaces the output. While the log is too short, an
/// InputError is printed once and does not end the loop. Returns the result of make(true). Throws UsageError: the output is
/// not a file, or there is no log; also as follow_log() and make(true) do.
[[nodiscard]] ExitCode update_while_growing(PartOptions& part, const FollowOptions& follow, const std::string& output,
                                            const std::function<ExitCode(bool last)>& make);

}  // namespace clsurf::cli

#pragma once
// `render --follow`, `report --follow`: an output that is made again while the log is written.

#include <functional>
#include <string>

#include "cli/options/follow.h"

namespace clsurf::cli {

/// Makes `output` of the log's whole records until now, again and again, at least 2 s apart and twice as long as one takes, and
/// of the complete log at the end. make(last) reads part.log_source and replaces the output; while the log is too short for it an
/// InputError is said once and not an end. Returns what make(true) does. Throws UsageError: the output is no file, or there is
/// no log; what follow_log() and make(true) throw.
[[nodiscard]] ExitCode make_while_it_grows(PartOptions& part, const FollowOptions& follow, const std::string& output,
                                           const std::function<ExitCode(bool last)>& make);

}  // namespace clsurf::cli

#pragma once
// The output of `check --follow` during and after the recording, as text and as JSON, one object per line. Keys:
// docs/howto/follow.md.

#include <string>

#include "core/error.h"
#include "pipeline/followed_run.h"

namespace clsurf::io {

/// Why following a log ended.
enum class FollowEnd {
    closed,       ///< its writer closed it
    timeout,      ///< it did not grow for the time of --follow-timeout
    interrupted,  ///< Ctrl-C, SIGTERM
};
[[nodiscard]] std::string_view name_of(FollowEnd end);  ///< "closed"

/// Each text ends with a line end.
[[nodiscard]] std::string finding_text(const ProvisionalDefect& found, double period);
[[nodiscard]] std::string finding_json(const ProvisionalDefect& found, double period);

/// `timeout` [s]: of --follow-timeout.
[[nodiscard]] std::string end_text(FollowEnd end, PointIndex records, double timeout);
[[nodiscard]] std::string end_json(FollowEnd end, PointIndex records);

/// The findings after judging the complete log. The indices of defects become ranks, from 1.
[[nodiscard]] std::string resolved_text(const ResolvedFindings& resolved);
/// One object for each finding: confirmed or withdrawn.
[[nodiscard]] std::string resolved_json(const ResolvedFindings& resolved);

/// The last object; `report`: the result of quality_json().
[[nodiscard]] std::string verdict_json(const ResolvedFindings& resolved, const std::string& report, ExitCode code);

}  // namespace clsurf::io

#pragma once
// What `check --follow` says while a log is written and at its end, as text and as JSON, one object a line. Keys: docs/howto/follow.md.

#include <string>

#include "core/error.h"
#include "pipeline/followed_run.h"

namespace clsurf::io {

/// Why a log was followed no longer.
enum class FollowEnd {
    closed,       ///< its writer closed it
    timeout,      ///< it did not grow for the time of --follow-timeout
    interrupted,  ///< Ctrl-C, SIGTERM
};
[[nodiscard]] std::string_view name_of(FollowEnd end);  ///< "closed"

/// Each text ends with an end of line.
[[nodiscard]] std::string finding_text(const ProvisionalDefect& found, double period);
[[nodiscard]] std::string finding_json(const ProvisionalDefect& found, double period);

/// `timeout` [s]: of --follow-timeout.
[[nodiscard]] std::string end_text(FollowEnd end, PointIndex records, double timeout);
[[nodiscard]] std::string end_json(FollowEnd end, PointIndex records);

/// What the complete log says of the findings. The indices of defects become ranks, from 1.
[[nodiscard]] std::string resolved_text(const ResolvedFindings& resolved);
/// One object for each finding: confirmed or withdrawn.
[[nodiscard]] std::string resolved_json(const ResolvedFindings& resolved);

/// The last object: `report` is what quality_json() wrote.
[[nodiscard]] std::string verdict_json(const ResolvedFindings& resolved, const std::string& report, ExitCode code);

}  // namespace clsurf::io

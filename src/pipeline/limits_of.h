#pragma once
// Compares the commanded motion of a part with limits, and provides the fields of its shares.

#include <memory>
#include <span>

#include "limits/limit_fields.h"
#include "limits/limit_report.h"
#include "pipeline/part.h"

namespace clsurf {

/// Compares every record with each of these limits (limits/judge_limits.h). Without commanded positions nothing is judged,
/// and a diagnostic says so.
[[nodiscard]] LimitReport judge_limits(const Part& part, std::span<const StatedLimit> limits);

/// Shares of the limits of the part's machine, for fields_of(). Shares the columns of the part.
[[nodiscard]] std::shared_ptr<const LimitFields> limit_fields(const Part& part);

}  // namespace clsurf

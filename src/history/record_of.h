#pragma once
// The record of a judged part in a history.

#include <vector>

#include "history/run_record.h"
#include "pipeline/judge.h"

namespace clsurf {

/// The defects of a report as they are stored in a history, in its order.
[[nodiscard]] std::vector<RecordedDefect> recorded_defects(const QualityReport& report);

/// Everything except data from files, user and clock: id, times, program, log and their hashes, machine, version,
/// parameters.
[[nodiscard]] RunRecord record_of(const Part& part, const Quality& quality, bool within_budget);

}  // namespace clsurf

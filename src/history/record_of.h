#pragma once
// What a history keeps of a judged part.

#include <vector>

#include "history/run_record.h"
#include "pipeline/judge.h"

namespace clsurf {

/// The defects of a report as a history keeps them, in its order.
[[nodiscard]] std::vector<RecordedDefect> recorded_defects(const QualityReport& report);

/// Everything but what files, user and clock say: id, times, program, log and their hashes, machine, version, parameters.
[[nodiscard]] RunRecord record_of(const Part& part, const Quality& quality, bool within_budget);

}  // namespace clsurf

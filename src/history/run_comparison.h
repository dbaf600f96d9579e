#pragma once
// RunComparison: comparison of a recorded run with an earlier one.

#include <span>
#include <vector>

#include "history/history_quantity.h"
#include "history/recorded_match.h"

namespace clsurf {

/// A quantity that both runs have.
struct QuantityChange {
    const HistoryQuantity* quantity = nullptr;
    double before = 0, after = 0;
};

struct RunComparison {
    std::vector<QuantityChange> quantities;
    RecordedMatch match;  ///< the run's defects among those of the reference
};

/// Both with their defects.
[[nodiscard]] RunComparison compare_runs(const RunRecord& reference, const RunRecord& run);

/// The judged run of that program with the lowest worst score, excluding `except`; among equals the one whose deepest
/// defect is shallower, then the earlier one. nullptr if there is none.
[[nodiscard]] const RunRecord* best_run(std::span<const RunRecord> runs, const RunRecord& except);

}  // namespace clsurf

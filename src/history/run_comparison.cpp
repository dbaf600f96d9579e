#include "history/run_comparison.h"

#include <cmath>
#include <tuple>

namespace clsurf {

RunComparison compare_runs(const RunRecord& reference, const RunRecord& run) {
    RunComparison comparison;
    for (const HistoryQuantity& quantity : history_quantities()) {
        const double before = quantity.of_run(reference);
        const double after = quantity.of_run(run);
        if (std::isfinite(before) && std::isfinite(after)) comparison.quantities.push_back({&quantity, before, after});
    }
    comparison.match = match_recorded(reference.found, run.found);
    return comparison;
}

const RunRecord* best_run(std::span<const RunRecord> runs, const RunRecord& except) {
    const RunRecord* best = nullptr;
    const auto badness = [](const RunRecord& r) { return std::tuple(r.worst_score, r.deepest_um); };
    for (const RunRecord& run : runs) {
        if (!run.judged || run.id == except.id || run.program_sha256 != except.program_sha256) continue;
        if (best == nullptr || badness(run) < badness(*best)) best = &run;
    }
    return best;
}

}  // namespace clsurf

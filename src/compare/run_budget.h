#pragma once
// Run budget: how far a run may differ from another one of the part.

#include <optional>
#include <span>

#include "compare/run_report.h"
#include "predictor/budget.h"

namespace clsurf {

/// Limits that are not set do not apply.
struct RunBudget {
    std::optional<double> max_speed_difference_percent;
    std::optional<double> max_acceleration_difference_mm_s2;
    std::optional<double> max_lag_difference_um;
    std::optional<double> max_height_difference_um;
    std::optional<double> max_time_difference_percent;
    std::optional<double> min_aligned_percent;
};

using RunBudgetLimit = BudgetLimit<RunReport, RunBudget>;
[[nodiscard]] std::span<const RunBudgetLimit> run_budget_limits();

/// The comparison with each limit that the budget sets.
[[nodiscard]] std::vector<BudgetLine> hold(const RunReport& report, const RunBudget& budget);

}  // namespace clsurf

#pragma once
// The limits in a budget: keys of the same file as those of predictor/verdict.h.

#include <optional>
#include <span>
#include <vector>

#include "limits/limit_report.h"
#include "predictor/budget.h"

namespace clsurf {

struct LimitBudget {
    std::optional<double> max_limit_factor;
    std::optional<double> max_following_error_um;  ///< of each linear axis
};

[[nodiscard]] std::span<const BudgetLimit<LimitReport, LimitBudget>> limit_budget_limits();
[[nodiscard]] std::vector<BudgetLine> hold(const LimitReport& report, const LimitBudget& budget);

/// The limits of the following error of axes x, y, z in the budget; empty: it has none.
[[nodiscard]] std::vector<StatedLimit> following_error_limits(const LimitBudget& budget);

}  // namespace clsurf

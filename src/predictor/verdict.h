#pragma once
// Verdict: the comparison of a report with a budget.

#include <optional>
#include <span>
#include <vector>

#include "predictor/budget.h"
#include "predictor/defect.h"

namespace clsurf {

/// Limits for a part; those that are not set do not apply.
struct QualityBudget {
    std::optional<double> max_depth_um;
    std::optional<double> max_defects;
    std::optional<double> max_severity;
    std::optional<double> max_area_mm2;
    std::optional<double> max_speed_mismatch_percent;
    std::optional<double> min_coverage_percent;
};

using QualityLimit = BudgetLimit<QualityReport, QualityBudget>;
[[nodiscard]] std::span<const QualityLimit> budget_limits();

/// The comparison with each limit that the budget sets. A report that is not judged meets none of them.
[[nodiscard]] std::vector<BudgetLine> hold(const QualityReport& report, const QualityBudget& budget);

}  // namespace clsurf

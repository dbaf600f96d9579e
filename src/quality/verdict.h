#pragma once
// Verdict: a report held against a budget.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quality/defects.h"

namespace clsurf {

/// What a part may have; what is not set is not limited.
struct Budget {
    std::optional<double> max_depth_um;
    std::optional<double> max_defects;
    std::optional<double> max_severity;
    std::optional<double> max_area_mm2;
    std::optional<double> max_speed_mismatch_percent;
    std::optional<double> min_coverage_percent;
};

/// One limit of a budget, by its name in the file.
struct BudgetLimit {
    std::string_view name;
    std::optional<double> Budget::* limit;
    double (*measure)(const QualityReport& report);
    bool at_least = false;  ///< the measure must reach the limit; else it must not pass it
};
[[nodiscard]] std::span<const BudgetLimit> budget_limits();

struct BudgetLine {
    std::string_view name;
    double measured = 0, limit = 0;
    bool held = false;
};

/// Every limit that the budget sets.
[[nodiscard]] std::vector<BudgetLine> hold(const QualityReport& report, const Budget& budget);
[[nodiscard]] bool all_held(const std::vector<BudgetLine>& lines);

}  // namespace clsurf

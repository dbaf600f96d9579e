#include "limits/limit_budget.h"

#include <algorithm>
#include <array>

#include "core/not_finite.h"

namespace clsurf {
namespace {

double limit_factor(const LimitReport& report) { return report.greatest_factor(); }

double following_error_um(const LimitReport& report) {
    double worst = missing<double>;
    for (const JudgedLimit& judged : report.judged) {
        if (judged.limit.quantity != LimitedQuantity::following_error) continue;
        const double um = judged.factor * judged.limit.value * um_per_mm;
        if (!(worst >= um)) worst = um;
    }
    return worst;
}

constexpr auto rows = std::to_array<BudgetLimit<LimitReport, LimitBudget>>({
    {"max_limit_factor", &LimitBudget::max_limit_factor, limit_factor},
    {"max_following_error_um", &LimitBudget::max_following_error_um, following_error_um},
});

}  // namespace

std::span<const BudgetLimit<LimitReport, LimitBudget>> limit_budget_limits() { return rows; }

std::vector<BudgetLine> hold(const LimitReport& report, const LimitBudget& budget) {
    return hold(limit_budget_limits(), report, budget);
}

std::vector<StatedLimit> following_error_limits(const LimitBudget& budget) {
    std::vector<StatedLimit> limits;
    if (!budget.max_following_error_um) return limits;
    for (const char axis : {'x', 'y', 'z'})
        limits.push_back({LimitedQuantity::following_error, axis, *budget.max_following_error_um / um_per_mm});
    return limits;
}

}  // namespace clsurf

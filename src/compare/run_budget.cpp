#include "compare/run_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace clsurf {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <RunQuantity quantity>
double most(const RunReport& report) {
    const RunQuantitySummary* summary = report.find(quantity);
    return summary == nullptr ? unknown : std::max(-summary->lowest, summary->highest);
}

double speed(const RunReport& report) {
    const RunQuantitySummary* summary = report.find(RunQuantity::speed);
    return summary == nullptr ? unknown : 100 * summary->relative_most;
}
double lag(const RunReport& report) { return um_per_mm * most<RunQuantity::following_error>(report); }
double height(const RunReport& report) { return um_per_mm * most<RunQuantity::height>(report); }
double time(const RunReport& report) { return 100 * std::abs(report.time_of_b - report.time) / report.time; }
double aligned(const RunReport& report) { return 100 * report.aligned / report.arc_length; }

constexpr auto run_limits = std::to_array<RunBudgetLimit>({
    {"max_speed_difference_percent", &RunBudget::max_speed_difference_percent, speed},
    {"max_acceleration_difference_mm_s2", &RunBudget::max_acceleration_difference_mm_s2,
     most<RunQuantity::acceleration>},
    {"max_lag_difference_um", &RunBudget::max_lag_difference_um, lag},
    {"max_height_difference_um", &RunBudget::max_height_difference_um, height},
    {"max_time_difference_percent", &RunBudget::max_time_difference_percent, time},
    {"min_aligned_percent", &RunBudget::min_aligned_percent, aligned, true},
});

}  // namespace

std::span<const RunBudgetLimit> run_budget_limits() { return run_limits; }

std::vector<BudgetLine> hold(const RunReport& report, const RunBudget& budget) {
    return hold(run_budget_limits(), report, budget);
}

}  // namespace clsurf

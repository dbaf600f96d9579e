#include "predictor/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"

namespace clsurf {
namespace {

template <typename Value>
double largest(const QualityReport& report, Value&& value) {
    double most = 0;
    for (const Defect& d : report.defects) most = std::max(most, static_cast<double>(value(d)));
    return most;
}

double depth(const QualityReport& r) {
    return largest(r, [](const Defect& d) { return d.depth * um_per_mm; });
}
double count(const QualityReport& r) { return static_cast<double>(r.defects.size()); }
double severity(const QualityReport& r) { return r.worst_severity(); }
double area(const QualityReport& r) {
    double sum = 0;
    for (const Defect& d : r.defects) sum += d.area;
    return sum;
}
double speed_mismatch(const QualityReport& r) {
    const double usual = 100.0 * r.thresholds.p99[index_of(Quantity::speed)];
    return std::max(usual, largest(r, [](const Defect& d) { return 100.0 * std::abs(d.speed_mismatch); }));
}
double coverage(const QualityReport& r) { return 100 * r.coverage(); }

constexpr auto quality_limits = std::to_array<QualityLimit>({
    {"max_depth_um", &QualityBudget::max_depth_um, depth},
    {"max_defects", &QualityBudget::max_defects, count},
    {"max_severity", &QualityBudget::max_severity, severity},
    {"max_area_mm2", &QualityBudget::max_area_mm2, area},
    {"max_speed_mismatch_percent", &QualityBudget::max_speed_mismatch_percent, speed_mismatch},
    {"min_coverage_percent", &QualityBudget::min_coverage_percent, coverage, true},
});

}  // namespace

std::span<const QualityLimit> budget_limits() { return quality_limits; }

std::vector<BudgetLine> hold(const QualityReport& report, const QualityBudget& budget) {
    std::vector<BudgetLine> lines = hold(budget_limits(), report, budget);
    if (!report.judgement.judged()) {
        for (BudgetLine& line : lines) line.held = false;
    }
    return lines;
}

}  // namespace clsurf

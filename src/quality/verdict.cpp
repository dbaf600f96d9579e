#include "quality/verdict.h"

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
    return std::max(usual, largest(r, [](const Defect& d) { return 100.0 * d.speed_mismatch; }));
}
double coverage(const QualityReport& r) { return 100 * r.coverage(); }

constexpr auto limits = std::to_array<BudgetLimit>({
    {"max_depth_um", &Budget::max_depth_um, depth},
    {"max_defects", &Budget::max_defects, count},
    {"max_severity", &Budget::max_severity, severity},
    {"max_area_mm2", &Budget::max_area_mm2, area},
    {"max_speed_mismatch_percent", &Budget::max_speed_mismatch_percent, speed_mismatch},
    {"min_coverage_percent", &Budget::min_coverage_percent, coverage, true},
});

}  // namespace

std::span<const BudgetLimit> budget_limits() { return limits; }

std::vector<BudgetLine> hold(const QualityReport& report, const Budget& budget) {
    std::vector<BudgetLine> lines;
    for (const BudgetLimit& limit : limits) {
        const std::optional<double>& value = budget.*limit.limit;
        if (!value) continue;
        const double measured = limit.measure(report);
        lines.push_back({limit.name, measured, *value, limit.at_least ? measured >= *value : measured <= *value});
    }
    return lines;
}

bool all_held(const std::vector<BudgetLine>& lines) {
    return std::all_of(lines.begin(), lines.end(), [](const BudgetLine& line) { return line.held; });
}

}  // namespace clsurf

#include "history/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/error.h"
#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr double significance = 0.05;  ///< the usual level

/// Ranks from 1; equal values share their mean rank.
std::vector<double> ranks_of(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        const double rank = 0.5 * static_cast<double>(first + end + 1);
        for (; first < end; ++first) ranks[order[first]] = rank;
    }
    return ranks;
}

double value_of(const RunRecord& run, const HistoryQuantity& quantity, const DefectFilter& filter) {
    if (!run.judged) return std::numeric_limits<double>::quiet_NaN();
    if (filter.empty()) return quantity.of_run(run);
    std::vector<RecordedDefect> chosen;
    std::ranges::copy_if(run.found, std::back_inserter(chosen),
                         [&](const RecordedDefect& d) { return filter.matches(d); });
    return quantity.of_defects(chosen);
}

std::vector<TrendGroup> groups_of(const std::vector<TrendPoint>& points) {
    std::map<std::string, std::vector<double>> values;
    for (const TrendPoint& point : points) {
        std::vector<double>& of_group = values[point.group];
        if (std::isfinite(point.value)) of_group.push_back(point.value);
    }
    std::vector<TrendGroup> groups;
    for (auto& [name, known] : values) {
        if (known.empty()) continue;
        groups.push_back({name, known.size(), midpoint_median(known), *std::ranges::max_element(known)});
    }
    std::ranges::stable_sort(groups, std::ranges::greater{}, &TrendGroup::median);
    return groups;
}

}  // namespace

std::string mark_of(const RunRecord& run, const std::string& by) {
    if (const std::string* value = run.parameter(by)) return *value;
    if (by == "program") return run.program;
    if (by == "machine") return run.machine;
    if (by == "tool") return run.tool;
    return {};
}

std::optional<TrendChange> find_change(std::span<const double> values) {
    if (values.size() < least_runs_for_change) return std::nullopt;
    const std::vector<double> ranks = ranks_of(values);
    const auto n = static_cast<double>(values.size());
    double sum = 0;
    double most = 0;
    std::size_t first = 0;
    for (std::size_t t = 0; t + 1 < values.size(); ++t) {
        sum += ranks[t];
        const double u = std::abs(2 * sum - static_cast<double>(t + 1) * (n + 1));
        if (u <= most) continue;
        most = u;
        first = t + 1;
    }
    TrendChange change;
    change.p = std::min(1.0, 2 * std::exp(-6 * most * most / (n * n * n + n * n)));
    if (!(change.p < significance)) return std::nullopt;
    change.first = first;
    const auto split = values.begin() + static_cast<std::ptrdiff_t>(first);
    change.before = midpoint_median(std::vector(values.begin(), split));
    change.after = midpoint_median(std::vector(split, values.end()));
    return change;
}

Trend make_trend(std::span<const RunRecord> runs, const HistoryQuantity& quantity, const DefectFilter& filter,
                 const std::string& by) {
    if (!filter.empty() && quantity.of_defects == nullptr)
        throw UsageError("--quantity " + std::string(quantity.name) +
                         " describes whole runs; --pass, --lines and --cause apply to defects only");
    Trend trend;
    std::vector<double> known;
    std::vector<std::size_t> at;
    for (const RunRecord& run : runs) {
        TrendPoint point{run.id, run.time, value_of(run, quantity, filter), by.empty() ? "" : mark_of(run, by)};
        if (std::isfinite(point.value)) {
            known.push_back(point.value);
            at.push_back(trend.points.size());
        }
        trend.points.push_back(std::move(point));
    }
    trend.change = find_change(known);
    if (trend.change) trend.change->first = at[trend.change->first];
    if (!by.empty()) trend.groups = groups_of(trend.points);
    return trend;
}

}  // namespace clsurf

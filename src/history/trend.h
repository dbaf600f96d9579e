#pragma once
// Trend: a quantity over the runs of a history, in their order: whether and when it changed, and how it depends on
// the values of a parameter.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "history/history_quantity.h"

namespace clsurf {

/// With fewer runs the test cannot reach p < 0.05 even if all rose at once: K ≤ ¼ n², p = 2 exp(−6 K²/(n³ + n²)).
constexpr std::size_t least_runs_for_change = 11;

struct TrendPoint {
    std::int64_t run = 0;  ///< its id
    std::string time;
    double value = 0;   ///< NaN: unknown
    std::string group;  ///< the value by which it is grouped; empty: it has none
};

/// A change of level.
struct TrendChange {
    std::size_t first = 0;         ///< index of the first point after the change
    double before = 0, after = 0;  ///< medians
    double p = 1;                  ///< probability of such a change in values in random order
};

struct TrendGroup {
    std::string name;
    std::size_t runs = 0;  ///< runs with a value
    double median = 0, most = 0;
};

struct Trend {
    std::vector<TrendPoint> points;
    std::optional<TrendChange> change;  ///< nullopt: none with p < 0.05
    std::vector<TrendGroup> groups;     ///< the highest median first; empty: the points are not grouped
};

/// The group of a run: its parameter of that name, else its "program", "machine" or "tool"; empty: it has none.
[[nodiscard]] std::string mark_of(const RunRecord& run, const std::string& by);

/// The rank test of Pettitt (1979) for one change of level: the point at which the rank sum of the first values deviates
/// most from that of a random order. nullopt: fewer than six values, or none with p < 0.05. Values must not be NaN. O(n
/// log n). Source: Pettitt, A. N.: A non-parametric approach to the change-point problem. Applied Statistics 28 (1979),
/// 126–135.
[[nodiscard]] std::optional<TrendChange> find_change(std::span<const double> values);

/// `by` empty: points are not grouped. Runs that failed or were not judged have no values of their passes. With a filter
/// the runs' defects must have been read. Throws UsageError: a filter for a quantity of the whole run.
[[nodiscard]] Trend make_trend(std::span<const RunRecord> runs, const HistoryQuantity& quantity,
                               const DefectFilter& filter, const std::string& by);

}  // namespace clsurf

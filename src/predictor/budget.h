#pragma once
// Budget: named limits, and the comparison of a report with those that are set.

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace clsurf {

/// One limit of a budget, with its name in the file.
template <typename Report, typename Budget>
struct BudgetLimit {
    std::string_view name;
    std::optional<double> Budget::*limit;
    double (*measure)(const Report& report);  ///< NaN: not known, so that no limit is met
    bool at_least = false;                    ///< the measure must reach the limit; false: it must not exceed it
};

struct BudgetLine {
    std::string_view name;
    double measured = 0, limit = 0;
    bool held = false;
};

/// The comparison with each limit that the budget sets, in the order of `limits`.
template <typename Report, typename Budget>
[[nodiscard]] std::vector<BudgetLine> hold(std::span<const BudgetLimit<Report, Budget>> limits, const Report& report,
                                           const Budget& budget) {
    std::vector<BudgetLine> lines;
    for (const BudgetLimit<Report, Budget>& limit : limits) {
        const std::optional<double>& value = budget.*limit.limit;
        if (!value) continue;
        const double measured = limit.measure(report);
        lines.push_back({limit.name, measured, *value, limit.at_least ? measured >= *value : measured <= *value});
    }
    return lines;
}

[[nodiscard]] inline bool all_held(std::span<const BudgetLine> lines) {
    return std::all_of(lines.begin(), lines.end(), [](const BudgetLine& line) { return line.held; });
}

}  // namespace clsurf

#pragma once
// HistoryQuantity: the numbers of a run that its history can show over time. To add one: a row of the table.

#include <optional>
#include <span>
#include <string_view>

#include "history/run_record.h"

namespace clsurf {

/// Selects defects. Empty: all.
struct DefectFilter {
    std::optional<std::int64_t> pass;                             ///< a section of that pass
    std::optional<std::pair<LineNumber, LineNumber>> lines = {};  ///< a section that has one of these lines
    std::string cause = {};                                       ///< "feed_drop"

    [[nodiscard]] bool empty() const { return !pass && !lines && cause.empty(); }
    [[nodiscard]] bool matches(const RecordedDefect& defect) const;
};

struct HistoryQuantity {
    std::string_view name;   ///< "worst_score", as in --quantity
    std::string_view label;  ///< "Worst score"
    std::string_view unit;   ///< "µm"; empty: none
    /// For a whole run that did not fail; NaN: unknown.
    double (*of_run)(const RunRecord& run);
    double least_deviation;  ///< a deviation from the median by 3.5 times this may be significant
    /// For some of its defects, possibly none; nullptr: the quantity exists for whole runs only.
    double (*of_defects)(std::span<const RecordedDefect> defects);
};

/// For the whole run; NaN: unknown, also if the run failed.
[[nodiscard]] double value_of(const HistoryQuantity& quantity, const RunRecord& run);

[[nodiscard]] std::span<const HistoryQuantity> history_quantities();
/// Throws UsageError with the nearest name.
[[nodiscard]] const HistoryQuantity& find_history_quantity(std::string_view name);

}  // namespace clsurf

#pragma once
// HistoryQuantity: the numbers of a run that its history can show over time. To add one: a row of the table.

#include <optional>
#include <span>
#include <string_view>

#include "history/run_record.h"

namespace clsurf {

/// Which defects count. Empty: all.
struct DefectFilter {
    std::optional<std::int64_t> pass;                             ///< a section of that pass
    std::optional<std::pair<LineNumber, LineNumber>> lines = {};  ///< a section that has one of these lines
    std::string cause = {};                                       ///< "feed_drop"

    [[nodiscard]] bool empty() const { return !pass && !lines && cause.empty(); }
    [[nodiscard]] bool matches(const RecordedDefect& defect) const;
};

struct HistoryQuantity {
    std::string_view name;   ///< "worst_score", as --quantity has it
    std::string_view label;  ///< "Worst score"
    std::string_view unit;   ///< "µm"; empty: none
    /// Of the whole run, which did not fail; NaN: not known.
    double (*of_run)(const RunRecord& run);
    double least_deviation;  ///< a run that differs from the usual one by 3.5 times that may be worth a look
    /// Of some of its defects, none of which may be there; nullptr: it is of the whole run only.
    double (*of_defects)(std::span<const RecordedDefect> defects);
};

/// Of the whole run; NaN: not known, as all of a run that failed.
[[nodiscard]] double value_of(const HistoryQuantity& quantity, const RunRecord& run);

[[nodiscard]] std::span<const HistoryQuantity> history_quantities();
/// Throws UsageError with the nearest one.
[[nodiscard]] const HistoryQuantity& find_history_quantity(std::string_view name);

}  // namespace clsurf

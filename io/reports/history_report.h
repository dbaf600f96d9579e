#pragma once
// What a history answers, as JSON and as text for people. Keys: docs/history.md.

#include <span>
#include <string>
#include <vector>

#include "history/outliers.h"
#include "history/run_comparison.h"
#include "history/run_record.h"
#include "history/trend.h"

namespace clsurf::io {

/// A trend with what it is of.
struct ReportedTrend {
    const Trend* trend = nullptr;
    const HistoryQuantity* quantity = nullptr;
    DefectFilter filter;
    std::string by;               ///< empty: not marked
    std::optional<double> limit;  ///< nothing: none was given
};

/// "pass 7", "lines 500-670", "feed_drop"; empty: all of the run.
[[nodiscard]] std::string text_of(const DefectFilter& filter);
/// Since when, by what, and how often over the limit: sentences with their ends.
[[nodiscard]] std::string trend_text(const ReportedTrend& reported);
[[nodiscard]] std::string trend_json(const ReportedTrend& reported);

/// "failed", "not judged", "over budget", "no defects", or its worst severity: "visible".
[[nodiscard]] std::string verdict_of(const RunRecord& run);

/// One row a run. Runs are in the order of their times.
[[nodiscard]] std::string history_text(std::span<const RunRecord> runs);
[[nodiscard]] std::string history_json(std::span<const RunRecord> runs);

/// All that is kept of a run, which has its defects.
[[nodiscard]] std::string run_text(const RunRecord& run);
[[nodiscard]] std::string run_json(const RunRecord& run);

[[nodiscard]] std::string outliers_text(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers);
[[nodiscard]] std::string outliers_json(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers);

[[nodiscard]] std::string comparison_text(const RunRecord& reference, const RunRecord& run,
                                          const RunComparison& comparison);
[[nodiscard]] std::string comparison_json(const RunRecord& reference, const RunRecord& run,
                                          const RunComparison& comparison);

}  // namespace clsurf::io

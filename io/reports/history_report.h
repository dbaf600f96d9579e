#pragma once
// The answers of a history, as JSON and as text. Keys: docs/history.md.

#include <span>
#include <string>
#include <vector>

#include "history/outliers.h"
#include "history/run_comparison.h"
#include "history/run_record.h"
#include "history/trend.h"

namespace clsurf::io {

/// A trend with its subject.
struct ReportedTrend {
    const Trend* trend = nullptr;
    const HistoryQuantity* quantity = nullptr;
    DefectFilter filter;
    std::string by;               ///< empty: not marked
    std::optional<double> limit;  ///< nothing: none was given
};

/// "pass 7", "lines 500-670", "feed_drop"; empty: the whole run.
[[nodiscard]] std::string text_of(const DefectFilter& filter);
/// Since when and by how much the value changed, and how often it exceeded the limit: sentences with line ends.
[[nodiscard]] std::string trend_text(const ReportedTrend& reported);
[[nodiscard]] std::string trend_json(const ReportedTrend& reported);

/// "failed", "not judged", "over budget", "no defects", or the worst severity: "visible".
[[nodiscard]] std::string verdict_of(const RunRecord& run);

/// One row per run. Runs are in order of time.
[[nodiscard]] std::string history_text(std::span<const RunRecord> runs);
[[nodiscard]] std::string history_json(std::span<const RunRecord> runs);

/// All that is stored of a run, with its defects.
[[nodiscard]] std::string run_text(const RunRecord& run);
[[nodiscard]] std::string run_json(const RunRecord& run);

[[nodiscard]] std::string outliers_text(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers);
[[nodiscard]] std::string outliers_json(std::span<const RunRecord> runs, std::span<const RunOutlier> outliers);

[[nodiscard]] std::string comparison_text(const RunRecord& reference, const RunRecord& run,
                                          const RunComparison& comparison);
[[nodiscard]] std::string comparison_json(const RunRecord& reference, const RunRecord& run,
                                          const RunComparison& comparison);

}  // namespace clsurf::io

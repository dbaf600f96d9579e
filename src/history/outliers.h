#pragma once
// Outliers: runs that deviate from the other runs of the same program, by any quantity.
//
// The criterion is a modified z-score 0.6745 (x − median) / MAD above 3.5. If more than half of the values are equal and
// the MAD is 0, the mean absolute deviation is used instead: (x − median) / (1.253314 · MeanAD).
// Source: Iglewicz and Hoaglin: How to Detect and Handle Outliers. ASQC Quality Press, 1993.

#include <optional>
#include <span>
#include <vector>

#include "history/history_quantity.h"

namespace clsurf {

struct RunOutlier {
    std::size_t run = 0;  ///< index among the given runs
    const HistoryQuantity* quantity = nullptr;
    double value = 0, usual = 0;  ///< value of the run, and median of all runs of the program
    double z = 0;                 ///< modified z-score
};

constexpr double outlier_score = 3.5;
constexpr std::size_t least_runs_for_outliers = 5;  ///< runs of a program; fewer are not informative

/// The modified z-score of each value; empty: all values are equal, or there are none. NaN stays NaN.
/// `least_deviation`: lower bound of the standard deviation, so that rounding does not make an outlier. O(n).
[[nodiscard]] std::vector<double> modified_z_scores(std::span<const double> values, double least_deviation = 0);

/// Largest z-score first. Judged runs only. O(runs · quantities).
[[nodiscard]] std::vector<RunOutlier> find_outliers(std::span<const RunRecord> runs);

}  // namespace clsurf

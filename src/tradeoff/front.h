#pragma once
// The Pareto front of time, mismatch between adjacent passes, and jerk; and the choice from it by a weight.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/motion_quality.h"
#include "predictor/defects.h"

namespace clsurf {

/// One way to run a part.
struct TradeoffRow {
    std::string name;  ///< "jerk 70 %, feed 80 %", "candidate 14"
    MotionQuality quality;
    std::size_t defects = 0;
    double deepest = 0;     ///< [mm] predicted depth of the deepest one
    bool on_front = false;  ///< no other row dominates it
};

/// `report`: of the same run.
[[nodiscard]] TradeoffRow row_of(std::string name, const MotionQuality& quality, const QualityReport& report);

/// The first row is what the others are compared with: the machine file, or the program, as it is.
struct TradeoffFront {
    std::vector<TradeoffRow> rows;
    std::optional<double> weight;       ///< of the surface, 0 … 1; nothing: none was given
    std::optional<std::size_t> chosen;  ///< a row
};

/// Whether `a` is as good as `b` in time, mismatch and jerk (95th percentiles), and better in one of them. A row that does
/// not know one of them dominates none and is dominated by none.
[[nodiscard]] bool dominates(const MotionQuality& a, const MotionQuality& b);

/// Sets `on_front`. A row that does not know its time, mismatch or jerk is never on it. O(rows · front).
void mark_front(std::vector<TradeoffRow>& rows);

/// What is least: (1 − W) t / t₀ + W (m / m₀ + j / j₀) / 2, relative to a reference. A quantity of the reference that is 0
/// stays as it is where it is 0, and is infinite where it rises.
[[nodiscard]] double weighted_cost(const MotionQuality& quality, const MotionQuality& reference, double weight);

/// The rows of the front in rising order of weighted_cost() relative to the first row. Of equal ones the one with the lower cost at a
/// weight of one half comes first. Domain: mark_front() was called; weight 0 … 1.
[[nodiscard]] std::vector<std::size_t> front_by_weight(std::span<const TradeoffRow> rows, double weight);

}  // namespace clsurf

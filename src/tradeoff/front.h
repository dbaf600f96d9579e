#pragma once
// The Pareto front of time, mismatch between adjacent passes, and jerk; and the choice of a row by a weight.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/motion_quality.h"
#include "predictor/defects.h"

namespace clsurf {

/// One candidate for running a part.
struct TradeoffRow {
    std::string name;  ///< "jerk 70 %, feed 80 %", "candidate 14"
    MotionQuality quality;
    std::size_t defects = 0;
    double deepest = 0;     ///< [mm] predicted depth of the deepest defect
    bool on_front = false;  ///< no other row dominates it
};

/// `report`: of the same run.
[[nodiscard]] TradeoffRow row_of(std::string name, const MotionQuality& quality, const QualityReport& report);

/// The first row is the reference for the others: the machine file, or the program, unchanged.
struct TradeoffFront {
    std::vector<TradeoffRow> rows;
    std::optional<double> weight;       ///< of the surface, 0 … 1; nullopt: none was given
    std::optional<std::size_t> chosen;  ///< index of a row
};

/// Whether `a` is at least as good as `b` in time, mismatch and jerk (95th percentiles), and better in one of them. A row
/// in which one of these is unknown dominates no row and is dominated by none.
[[nodiscard]] bool dominates(const MotionQuality& a, const MotionQuality& b);

/// Sets `on_front`. A row whose time, mismatch or jerk is unknown is never on the front. O(rows · front).
void mark_front(std::vector<TradeoffRow>& rows);

/// The cost to be minimised: (1 − W) t / t₀ + W (m / m₀ + j / j₀) / 2, relative to a reference. If a quantity of the
/// reference is 0, its term is unchanged while it remains 0, and infinite if it rises.
[[nodiscard]] double weighted_cost(const MotionQuality& quality, const MotionQuality& reference, double weight);

/// The rows of the front in ascending order of weighted_cost() relative to the first row. Of rows with equal cost, the one
/// with the lower cost at weight 1/2 comes first. Domain: mark_front() was called; weight 0 … 1.
[[nodiscard]] std::vector<std::size_t> front_by_weight(std::span<const TradeoffRow> rows, double weight);

}  // namespace clsurf

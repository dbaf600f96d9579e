#pragma once
// Drifted run: of three or more runs of a part, the one that deviates from the others. At each place the median of all runs is
// the reference, so the reference run A may itself have drifted.

#include <optional>
#include <vector>

#include "compare/run_difference.h"

namespace clsurf {

/// How far a run deviates from the median run.
struct RunDeparture {
    std::array<double, run_quantities> rms{};   ///< inside units; NaN: not known
    double score = 0;                           ///< the largest rms over its threshold
    RunQuantity quantity = RunQuantity::speed;  ///< the quantity with this score
};

class DriftFinder {
public:
    /// Selects places that are evenly spaced along the path of run A.
    explicit DriftFinder(const ClSurface& surface);

    /// Adds another run that was compared with A. O(places).
    void add(const RunDifferences& differences);

    /// Deviations of A, and of the added runs in their order. Empty if there are fewer than three.
    [[nodiscard]] std::vector<RunDeparture> departures() const;

private:
    std::vector<PointIndex> places_;
    std::vector<std::array<std::vector<float>, run_quantities>> runs_;  ///< values at the places
    std::array<double, run_quantities> threshold_{};
};

/// The run that deviates by more than a threshold, and twice as far as any other; nullopt if there is none.
[[nodiscard]] std::optional<std::size_t> drifted_run(const std::vector<RunDeparture>& departures);

}  // namespace clsurf

#pragma once
// The run that drifted: of three or more runs of a part, the one that departs from the others. At each place
// the median of all runs is normal, so the reference run itself may be the one that drifted.

#include <optional>
#include <vector>

#include "compare/run_difference.h"

namespace clsurf {

/// How far a run deviates from the median run.
struct RunDeparture {
    std::array<double, run_quantities> rms{};   ///< inside units; NaN: not known
    double score = 0;                           ///< the greatest rms over its threshold
    RunQuantity quantity = RunQuantity::speed;  ///< that has it
};

class DriftFinder {
public:
    /// Places evenly spaced along the path of run A.
    explicit DriftFinder(const ClSurface& surface);

    /// Another run that was compared with A. O(places).
    void add(const RunDifferences& differences);

    /// Of A and then of the runs added, in their order. Empty where there are fewer than three.
    [[nodiscard]] std::vector<RunDeparture> departures() const;

private:
    std::vector<PointIndex> places_;
    std::vector<std::array<std::vector<float>, run_quantities>> runs_;  ///< values at the places
    std::array<double, run_quantities> threshold_{};
};

/// The run that departs by more than a threshold, and twice as far as any other; none where no run does.
[[nodiscard]] std::optional<std::size_t> drifted_run(const std::vector<RunDeparture>& departures);

}  // namespace clsurf

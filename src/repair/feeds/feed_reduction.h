#pragma once
// Feed reduction: speeds that remove the remaining defects of a run, for as many of them as the time budget allows.

#include <vector>

#include "machine/machine.h"
#include "repair/feeds/ramp.h"
#include "repair/judged_run.h"

namespace clsurf {

struct FeedReductionRules {
    double step = 0.02;    ///< as a share: how much faster than the adjacent pass a place in or next to a defect may be
    double budget = 0;     ///< [s] time that may be lost
    double lag_power = 0;  ///< exponent of the speed with which lag steps grow
    Ramp ramp{};           ///< of the machine
    std::vector<Vec3> abandoned{};  ///< [mm] places of defects that are no longer repaired
};

/// Exponent of the speed v with which the normal deviation that alternates with the direction of travel grows. A loop lags by
/// c₁x′ + c₂x″ + c₃x‴ + …: if the axes have the same loop, c₁x′ is along the path and c₂x″ is the same in both directions, so
/// the third term remains: v³. If the loops differ, c₁x′ leaves the path: v.
[[nodiscard]] double lag_power(const Machine& machine);

struct ReducedSpeeds {
    std::vector<float> speeds;         ///< [mm/s] one per point; NaN: it is not compared
    std::vector<std::int32_t> causes;  ///< per point the index of the defect that it is equalised for; −1: none
};

/// Speeds that are equal within `step` around the defects of motion and lag. Around a lag defect they are also lowered until
/// lag steps are within the threshold, if that takes at most four tenths of the speed. Defects of the programmed relief are
/// excluded. The most expensive of the others, each priced alone, are dropped until all together lose no more than the budget,
/// by the times of the points. O(points · defects).
[[nodiscard]] ReducedSpeeds reduced_speeds(const JudgedRun& run, const FeedReductionRules& rules);

/// Per defect of a run: the reduction of the number of defects around the places that were slowed for it, on another run of the
/// same path; 0 if none was slowed. O(points).
[[nodiscard]] std::vector<int> gains_of(const ReducedSpeeds& reduction, const JudgedRun& run, const JudgedRun& reduced);

}  // namespace clsurf

#pragma once
// Cure: where a run still has defects, speeds that leave none, for as many of them as there is time for.

#include <vector>

#include "machine/machine.h"
#include "optimize/ramp.h"
#include "optimize/run.h"

namespace clsurf {

struct CureRules {
    double step = 0.02;    ///< a share: how much faster than the pass beside it a place in or next to a defect may be
    double budget = 0;     ///< [s] that may be lost
    double lag_power = 0;  ///< of the speed, that lag steps grow with
    Ramp ramp{};           ///< of the machine
    std::vector<Vec3> hopeless{};  ///< [mm] places of defects that are let be
};

/// With which power of the speed v the part of the following error grows that lies across the path and differs forth
/// and back. A loop lags by c₁x′ + c₂x″ + c₃x‴ + …: where the axes have the same loop, c₁x′ runs along the path and
/// c₂x″ is the same both ways, which leaves the third, v³; where they have different ones, c₁x′ leaves the path: v.
[[nodiscard]] double lag_power(const Machine& machine);

struct CuringSpeeds {
    std::vector<float> speeds;         ///< [mm/s] one a point; NaN: it is not compared
    std::vector<std::int32_t> causes;  ///< per point the index of the defect that it is levelled for; −1: none
};

/// Speeds that are level within `step` about the defects of motion and lag, and so low that their lag steps
/// keep the threshold, where that takes no more than four tenths of the speed. Defects of the programmed relief are left
/// out, and of the others the dearest, each by what it costs alone, as long as all together would lose more than the budget: by
/// the points' own times. O(points · defects).
[[nodiscard]] CuringSpeeds curing_speeds(const JudgedRun& run, const CureRules& rules);

/// Per defect of a run how many defects there are fewer about the places that were slowed for it, on another run of the same
/// path; 0 where nothing was. O(points).
[[nodiscard]] std::vector<int> gains_of(const CuringSpeeds& cure, const JudgedRun& run, const JudgedRun& cured);

}  // namespace clsurf

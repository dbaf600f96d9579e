#pragma once
// Regions: where a changed program runs worse than its original, so that the old points are better there.

#include <cstdint>
#include <vector>

#include "repair/judged_run.h"

namespace clsurf {

struct RegionRules {
    double cell = 4;        ///< [step-overs] side of the cells that are told apart, …
    double least_cell = 1;  ///< [mm] … at least; …
    int cells_aside = 1;  ///< … what lies so many to each side counts with each: a region covers the passes beside, too
};

/// Per motion of the program: 1 if `after`, a run of the program with other points, is worse in cells of space than
/// `before`, the run of the program itself: more defects or larger speed differences to the adjacent passes, each as a
/// fraction of the total of `before`. If `after` takes longer in total, the cells that cost most time for their benefit
/// count as well, until the rest takes no longer. O(points).
[[nodiscard]] std::vector<std::uint8_t> worse_motions(const JudgedRun& before, const JudgedRun& after,
                                                      const Program& program, const RegionRules& rules);

}  // namespace clsurf

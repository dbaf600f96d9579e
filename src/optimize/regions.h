#pragma once
// Regions: where a changed program runs worse than the one it comes from, so that the old points are better there.

#include <cstdint>
#include <vector>

#include "optimize/run.h"

namespace clsurf {

struct RegionRules {
    double cell = 4;        ///< [step-overs] side of the cells that are told apart, …
    double least_cell = 1;  ///< [mm] … at least; …
    int cells_aside = 1;  ///< … what lies so many to each side counts with each: a region covers the passes beside, too
};

/// Per motion of the program 1 where `after`, a run of the program with other points, is worse in cells of space than
/// `before`, its own run: more defects or larger differences of speed to the neighbour passes, each as a share of what `before` has in all. Where `after`
/// takes longer on the whole, so are the cells that cost most time for what they gain, until the others do not. O(points).
[[nodiscard]] std::vector<std::uint8_t> worse_motions(const JudgedRun& before, const JudgedRun& after,
                                                      const Program& program, const RegionRules& rules);

}  // namespace clsurf

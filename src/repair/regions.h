#pragma once
// Regions: which of several variants of a program runs best at each place.

#include <cstdint>
#include <span>
#include <vector>

#include "repair/judged_run.h"

namespace clsurf {

struct RegionRules {
    double cell = 4;        ///< [step-overs] side of cells …
    double least_cell = 1;  ///< [mm] … at least …
    int cells_aside = 1;    ///< … each with so many cells to each side, to include adjacent passes
    double more_time = 0;   ///< [periods] additional time of all regions together, compared with the first run
};

/// Per motion of the program: the run that is best in the cells of space around it. The first run is that of the program
/// itself; the others are runs of it with other points or feeds. The best run has the fewest defects and the smallest
/// differences of speed to the adjacent passes, each as a share of the total of the first run. Run `usual` is preferred if no
/// other one is better, and where the first run has no data. If all together take too long, time counts as well, at the lowest
/// price for which they do not; but no place gets a run that is worse there than the first one. At most 256 runs. O(points ·
/// runs).
[[nodiscard]] std::vector<std::uint8_t> best_runs(std::span<const JudgedRun* const> runs, std::size_t usual,
                                                  const Program& program, const RegionRules& rules);

}  // namespace clsurf

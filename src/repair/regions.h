#pragma once
// Regions: which of several ways to write a program runs best where.

#include <cstdint>
#include <span>
#include <vector>

#include "repair/judged_run.h"

namespace clsurf {

struct RegionRules {
    double cell = 4;        ///< [step-overs] side of the cells that are told apart, …
    double least_cell = 1;  ///< [mm] … at least; …
    int cells_aside = 1;  ///< … what lies so many to each side counts with each: a region covers the passes beside, too
    double more_time = 0;  ///< [periods] that all together may take longer than the first run
};

/// Per motion of the program: which of the runs is best in the cells of space about it. The first run is that of the program
/// itself; the others are runs of it with other points or feeds. Best is where defects, and differences of speed to the
/// adjacent passes, are least, each as a share of the total of the first run. Run `usual` is preferred to those that are
/// no better, and where the first run has no data. If all together take too long, time counts as well, at the lowest price
/// at which they do not; but no place gets a run that is worse there than the first one. At most 256 runs.
/// O(points · runs).
[[nodiscard]] std::vector<std::uint8_t> best_runs(std::span<const JudgedRun* const> runs, std::size_t usual,
                                                  const Program& program, const RegionRules& rules);

}  // namespace clsurf

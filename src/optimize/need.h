#pragma once
// Need: which motions of a program a run shows to be in need of repair, the run simulated or recorded.

#include <cstdint>
#include <vector>

#include "optimize/run.h"

namespace clsurf {

struct NeedRules {
    double share = 0.25;   ///< of the threshold of a speed step, from which on a place is repaired
    double reach = 4;      ///< [mm] of way before and behind such a place
    int passes_aside = 4;  ///< which are repaired with it
};

/// Per motion of the program 1 where it has points that differ from those beside them in speed, or lie in a
/// defect of motion or of point spacing, or near such a point; 0 elsewhere, and where the run does not tell. Lags alone are
/// the machine's: no other points cure them. O(points).
[[nodiscard]] std::vector<std::uint8_t> motions_in_need(const JudgedRun& run, const Program& program,
                                                        const NeedRules& rules);

/// Per motion of the program 1 where a run has points with a mark, one a point; what lies between the lines of two marked points
/// was passed within a period, and counts. O(points).
[[nodiscard]] std::vector<std::uint8_t> marked_motions(const JudgedRun& run, const Program& program,
                                                       const std::vector<std::uint8_t>& marks);

}  // namespace clsurf

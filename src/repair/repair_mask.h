#pragma once
// Repair mask: the motions of a program that need repair, as shown by a simulated or recorded run.

#include <cstdint>
#include <vector>

#include "repair/judged_run.h"

namespace clsurf {

struct RepairMaskRules {
    double share = 0.25;   ///< share of the threshold of a speed step from which on a place is repaired
    double reach = 4;      ///< [mm] of arc length before and after such a place, …
    int passes_aside = 4;  ///< … and number of passes to each side that are also repaired
    double slow = 0;  ///< share of the usual speed: slower places are also repaired, whatever the adjacent passes do
};

/// Per motion of the program: 1 if it has points whose speed differs from that of their neighbours, or that are in or near a
/// defect of motion or of point spacing; 0 otherwise, and where the run has no data. Defects of lag alone are caused by the
/// machine, and other points do not remove them. O(points).
[[nodiscard]] std::vector<std::uint8_t> repair_mask(const JudgedRun& run, const Program& program,
                                                    const RepairMaskRules& rules);

/// Per motion of the program: 1 if a run has marked points on it, one flag per point. Motions between the lines of two
/// consecutive marked points were traversed within one period and also count. O(points).
[[nodiscard]] std::vector<std::uint8_t> marked_motions(const JudgedRun& run, const Program& program,
                                                       const std::vector<std::uint8_t>& marks);

}  // namespace clsurf

#pragma once
// Defect match: which defects of one run exist in another run of the same part: gone, new, remaining.
//
// Two defects are the same mark if they are of one kind (motion or height) and cover the same section of the same pass: at
// least a quarter of the shorter one is within three quarters of a step-over of the other. Positions decide, not line or pass
// numbers, so a repaired program can be compared with the original.

#include <optional>
#include <vector>

#include "predictor/defect.h"
#include "toolpath/positions.h"

namespace clsurf {

/// The defects of a run, and the positions to which their points refer.
struct LocatedDefects {
    const std::vector<Defect>* defects = nullptr;
    const Positions* positions = nullptr;
    double step_over = 0;  ///< [mm] 0: not known
};

struct DefectMatch {
    std::vector<std::optional<std::size_t>> before_of;  ///< per defect of the later run; nullopt: it is new
    std::vector<std::size_t> gone;  ///< defects of the earlier run that are missing in the later one

    [[nodiscard]] std::size_t remaining() const;  ///< of the later run
    [[nodiscard]] std::size_t fresh() const;      ///< of the later run
};

/// A defect that split into several remains in each of them. O(points of defects).
[[nodiscard]] DefectMatch match_defects(const LocatedDefects& before, const LocatedDefects& after);

}  // namespace clsurf

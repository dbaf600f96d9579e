#pragma once
// Defect match: which defects of one run are there in another one of the same part: gone, new, remaining.
//
// Two defects are the same mark if they are of one kind (motion, or height) and run over the same section of the same
// pass: at least a quarter of the shorter one lies within three quarters of a step-over of the other. Places decide,
// not lines and numbers of passes, so a repaired program compares with the one before.

#include <optional>
#include <vector>

#include "predictor/defect.h"
#include "toolpath/positions.h"

namespace clsurf {

/// The defects of a run, and the positions that their points are of.
struct LocatedDefects {
    const std::vector<Defect>* defects = nullptr;
    const Positions* positions = nullptr;
    double step_over = 0;  ///< [mm] 0: not known
};

struct DefectMatch {
    std::vector<std::optional<std::size_t>> before_of;  ///< per defect of the later run; nullopt: it is new
    std::vector<std::size_t> gone;  ///< defects of the earlier run that are in the later one no more

    [[nodiscard]] std::size_t remaining() const;  ///< of the later run
    [[nodiscard]] std::size_t fresh() const;      ///< of the later run
};

/// One that broke into several remains in each of them. O(points of defects).
[[nodiscard]] DefectMatch match_defects(const LocatedDefects& before, const LocatedDefects& after);

}  // namespace clsurf

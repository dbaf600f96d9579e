#pragma once
// Explanations: which of the differences at one place is the effect of another one. The motion makes the heights of the
// machine. The program makes its own heights, and the controller may slow down for them.

#include <span>
#include <vector>

#include "predictor/defect.h"
#include "predictor/defect_core.h"

namespace clsurf {

/// A defect with the sites that it was built from, in the order of their points.
struct BuiltDefect {
    Defect defect;
    DefectCandidates core;
    bool expected = false;
    bool listed = true;  ///< large enough
};

/// The defects that no other one explains. `of_family`: of the motion, the lag and the relief, two vectors for each. `period` [s].
/// - A motion explains the heights of the machine at its place, lag and path tolerance: at least half of their sites, up
///   to 20 ms beside its own. Several motions may do so together, as where every level of a tower has a link of its own.
/// - A height that the program has is never explained, unless by an expected motion. It explains the motions and lags at its place
///   whose severity is no higher, and from severity 3 on also their score: a shallow offset is no reason for a deep drop of the speed.
/// O(sites log sections), with one comparison for each height of the program and each other defect.
[[nodiscard]] std::vector<BuiltDefect> unexplained(std::span<std::vector<BuiltDefect>> of_family, double period);

}  // namespace clsurf

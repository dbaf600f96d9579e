#pragma once
// Explanations: which differences at a place are effects of another difference there. The motion causes heights of the
// machine. The program has heights of its own, and the controller may slow down for them.

#include <span>
#include <vector>

#include "predictor/defect.h"
#include "predictor/defect_core.h"

namespace clsurf {

/// A defect with the sites that form it, in the order of their points.
struct BuiltDefect {
    Defect defect;
    DefectCandidates core;
    bool expected = false;
    bool listed = true;  ///< large enough
};

/// The defects that no other one explains. `of_family`: two vectors each for motion, lag and relief. `period` [s].
/// - A motion explains the heights of the machine (lag and path tolerance) at its place, if at least half of their sites are
///   within 20 ms of its own. Several motions may explain one together, for example if every level of a tower has a link.
/// - A height of the program is explained only by an expected motion. It explains the motions and lags at its place whose
///   severity is no higher; from severity 3 on, their score must not be higher either, because a shallow offset does not
///   explain a deep drop of the speed.
/// O(sites log sections), with one comparison for each height of the program and each other defect.
[[nodiscard]] std::vector<BuiltDefect> unexplained(std::span<std::vector<BuiltDefect>> of_family, double period);

}  // namespace clsurf

#pragma once
// Opposites: sections of a group of candidates that differ from the adjacent passes in opposite directions. A pit next to a
// bulge is two defects. As one defect, it would have the depth of the deeper one and a place between both.
//
// Three cases have both signs but are not split: a difference that alternates with the direction of travel (the lag of a
// zigzag); an oscillation, which changes its sign along one pass (a height at least twice); and the edge of a band of passes.
// There, the passes on both sides of the edge differ from the median of both in opposite directions, and each agrees with the
// next one on its own side.

#include "predictor/candidates.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// The groups into which `core` is split, each in the order of its points: one, or those above and those below. `along`:
/// joined_along(). Accelerations have no sign. O(sites log sites).
[[nodiscard]] std::vector<DefectCandidates> split_opposites(const DefectCandidates& core, Quantity quantity,
                                                            const Signals& signals, const ArcLength& arc_length,
                                                            double along);

}  // namespace clsurf

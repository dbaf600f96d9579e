#pragma once
// The step-over of a finishing program: the distance of adjacent passes, estimated from the path itself
// (median distance from a sample to the nearest part of the path that is not its own pass).

#include "surface/cut_groups.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

/// Step-over [mm] of the cutting runs; 0 if no part of the path has another next to it (a single pass). `groups`: of
/// the runs. O(points), parallel.
[[nodiscard]] double estimate_step_over(const Positions& positions, const Passes& runs, const ArcLength& arc_length,
                                        const CutGroups& groups = {});

}  // namespace clsurf

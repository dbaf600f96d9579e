#pragma once
// Run alignment: two runs of a part, aligned by path, not by time. For each point of run A it gives the location on run B where
// the tool was at the same place of the same pass.
//
// Both runs follow the same path, so the locations on B only move forward. Each point of A is projected onto B. The search
// starts from the last projection and covers the arc length that the tool can have travelled since. Among equally near
// projections, the one with the matching arc length is chosen (back and forth on one line, or a path that crosses itself). If A
// rests, its projection rests; if B rests, its points are at one place and add no arc length. An alignment starts wherever the
// runs are close to each other, and restarts after a section that only one run has (a retract, another beginning). If several
// places match (a contour that is cut three times), all are followed at the same time, and the longest match is chosen.

#include <vector>

#include "surface/path_location.h"

namespace clsurf {

struct RunAlignment {
    Column<PathLocation> locations;    ///< on B, per point of A; exists() is false where B has no such place
    std::vector<PointRange> sections;  ///< sections of A, in order: aligned throughout, without a jump on B
    double aligned = 0;                ///< [mm] arc length of A with a location
    double arc_length = 0;             ///< [mm] total arc length of A
};

/// Positions may have different origins. O(points of both). The work of following several places is limited to eight times
/// that.
[[nodiscard]] RunAlignment align_runs(const Positions& a, const Positions& b);

}  // namespace clsurf

#pragma once
// Run alignment: two runs of a part aligned by path, not by time: for each point of run A the place of run B
// where the tool was at the same spot of the same pass.
//
// Both follow the same path, so the places of B only go forward. Each point of A is projected onto B. The
// search starts from the last projection and covers the arc length that the tool can have travelled since.
// Among equally near projections, the one whose arc length fits wins (back and forth on one line, a path that
// crosses itself). If A rests, its projection rests; if B rests, its points are at one spot and add no arc
// length. An alignment starts wherever the runs are close to each other, and starts again after a section that
// only one run has (a retract, another beginning). If several places match (a contour that is cut three
// times), all are followed at once, and the longest match wins.

#include <vector>

#include "surface/path_location.h"

namespace clsurf {

struct RunAlignment {
    Column<PathLocation> locations;    ///< on B, per point of A; exists() is false where B has no such place
    std::vector<PointRange> sections;  ///< of A: aligned throughout and without a jump in B, in order
    double aligned = 0;                ///< [mm] arc length of A with a location
    double arc_length = 0;             ///< [mm] arc length of A in all
};

/// Positions may have different origins. O(points of both); walks that go on from several places at
/// once are bounded by eight times that.
[[nodiscard]] RunAlignment align_runs(const Positions& a, const Positions& b);

}  // namespace clsurf

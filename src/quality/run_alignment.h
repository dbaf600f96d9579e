#pragma once
// Run alignment: two runs of a part laid onto each other by path, not by time: for each point of run A
// the place of run B where the tool was at the same spot of the same pass.
//
// Both walk along the same path, so the places of B only go forward: the foot of each point of A is
// looked for from the last foot on, in a window of the way that the tool can have gone since, and among
// equally near feet the one whose way fits wins (out and back on one way, a path that crosses itself).
// Where A stands still the foot does; where B does, its points lie on one spot and cost no way. Walks
// begin, and go on after a place that only one run has (a retract, another beginning), wherever the runs
// lie on each other again; where that is several places (a contour cut three times) they are all walked
// at once, and the one that fits longest is taken.

#include <vector>

#include "surface/station.h"

namespace clsurf {

struct RunAlignment {
    Column<Station> stations;           ///< on B, per point of A; exists() is false where B has no such place
    std::vector<PointRange> stretches;  ///< of A: aligned throughout and without a jump in B, in order
    double aligned = 0;                 ///< [mm] way of A with a station
    double way = 0;                     ///< [mm] way of A in all
};

/// Positions may have different origins. O(points of both); walks that go on from several places at
/// once are bounded by eight times that.
[[nodiscard]] RunAlignment align_runs(const Positions& a, const Positions& b);

}  // namespace clsurf

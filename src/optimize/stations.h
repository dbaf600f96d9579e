#pragma once
// Stations: places along neighbour passes that lie side by side. A phase runs along every pass; where it
// passes a whole number there is a station, and the phase of a place is that of the place beside it on a
// pass that was programmed before. Points put at stations are therefore in step with the neighbours'.

#include <cstdint>
#include <vector>

#include "optimize/programmed_surface.h"

namespace clsurf {

struct Phases {
    std::vector<double> of_point;  ///< per point of the surface; NaN: not on a cut pass
    double spacing = 0;            ///< [mm] of way between whole numbers where no pass lies beside
};

/// Phases of all cut passes in the order of the program. Where passes fan out or in, the phase is
/// doubled or halved from pass to pass, so that stations stay between 0.7 and 1.4 spacings apart on the
/// whole. O(points).
[[nodiscard]] Phases run_phases(const ProgrammedSurface& laid, double spacing);

inline constexpr double nearest_station = 0.35;  ///< of a line: a station nearer to a fixed point is left out

/// A station on a stretch of a pass.
struct StationOfPass {
    double way = 0;           ///< [mm] from where the stretch begins
    std::int64_t number = 0;  ///< its phase in quarters
    double part = 0;          ///< [mm] of way in a quarter
};

/// Stations between two points of the surface, from a margin behind the first to one before the last, `length` [mm] of way
/// from it. Where passes fan out, halves and quarters of a phase are stations, too. O(points).
[[nodiscard]] std::vector<StationOfPass> stations_between(const ProgrammedSurface& laid, const Phases& phases,
                                                          PointIndex first, PointIndex last, double length);

}  // namespace clsurf

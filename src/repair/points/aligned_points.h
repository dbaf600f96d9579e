#pragma once
// Stations: aligned places on adjacent passes. A phase runs along every pass, and there is a station at each
// whole number. The phase of a place is that of the adjacent place on a pass that was programmed earlier.
// Points at stations are therefore aligned with those of the neighbours.

#include <cstdint>
#include <vector>

#include "surface/programmed_surface.h"

namespace clsurf {

struct Phases {
    std::vector<double> of_point;  ///< per point of the surface; NaN: not on a cut pass
    double spacing = 0;            ///< [mm] of way between whole numbers where no pass lies beside
};

/// Phases of all cut passes in the order of the program. Where passes fan out or in, the phase is doubled or halved
/// from pass to pass, so that most stations are 0.7 to 1.4 spacings apart. O(points).
[[nodiscard]] Phases run_phases(const ProgrammedSurface& laid, double spacing);

inline constexpr double nearest_station = 0.35;  ///< of a line: a station nearer to a fixed point is left out

/// A station on a section of a pass.
struct StationOfPass {
    double way = 0;           ///< [mm] from where the stretch begins
    std::int64_t number = 0;  ///< its phase in quarters
    double part = 0;          ///< [mm] of way in a quarter
};

/// Stations between two points of the surface, from a margin after the first one to a margin before the last one, which
/// is `length` [mm] of arc length away. Where passes fan out, halves and quarters of a phase are stations too.
/// O(points).
[[nodiscard]] std::vector<StationOfPass> stations_between(const ProgrammedSurface& laid, const Phases& phases,
                                                          PointIndex first, PointIndex last, double length);

}  // namespace clsurf

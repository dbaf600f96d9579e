#pragma once
// Aligned points: places on adjacent passes that are next to each other. A phase runs along every pass, and an aligned point is
// at each whole number. The phase of a place is that of the adjacent place on the pass that was programmed earlier, so that the
// aligned points of neighbours are next to each other.

#include <cstdint>
#include <vector>

#include "surface/programmed_surface.h"

namespace clsurf {

struct Phases {
    std::vector<double> of_point;  ///< per point of the surface; NaN: not on a cut pass
    double spacing = 0;            ///< [mm] of arc length between whole numbers if there is no adjacent pass
};

/// Phases of all cut passes in the order of the program. Where passes diverge or converge, the phase is doubled or halved from
/// pass to pass, so that most aligned points are 0.7 to 1.4 spacings apart. O(points).
[[nodiscard]] Phases run_phases(const ProgrammedSurface& programmed, double spacing);

inline constexpr double nearest_aligned_point =
    0.35;  ///< share of a line: aligned points nearer to a fixed point are omitted

/// An aligned point on a section of a pass.
struct AlignedPoint {
    double arc_length = 0;    ///< [mm] from the beginning of the section
    std::int64_t number = 0;  ///< its phase in quarters
    double part = 0;          ///< [mm] of arc length per quarter
    bool fixed = false;       ///< a line ends here in any case
};

/// Aligned points between two points of the surface, from a margin after the first one to a margin before the last one, which
/// is `length` [mm] of arc length away. Where passes diverge, halves and quarters of a phase are also aligned points.
/// O(points).
[[nodiscard]] std::vector<AlignedPoint> aligned_points_between(const ProgrammedSurface& programmed,
                                                               const Phases& phases, PointIndex first, PointIndex last,
                                                               double length);

}  // namespace clsurf

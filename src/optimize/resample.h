#pragma once
// Resampling: new points for stretches of a program, in step with the neighbour passes, on Akima's curve
// through the old ones, never farther from the programmed lines than a bound.

#include <vector>

#include "optimize/line_edit.h"
#include "optimize/programmed_surface.h"

namespace clsurf {

struct ResampleRules {
    double tolerance = 0.005;   ///< [mm] from the programmed path, all in all
    double spacing = 0;         ///< [mm] of way between points; 0: by curvature and the program's own spacing
    double corner_angle = 0.5;  ///< [rad] a point where the path turns by more stays where it is
};

/// Motions first … last (lines that may be rewritten, on one pass) and the points that take the place of
/// their ends. The last point is where they ended.
struct Stretch {
    std::int64_t first = 0, last = 0;
    std::vector<Vec3> points;  ///< [mm]
};

/// The spacing that a program's points should have [mm]: its own usual one, or less where curvature asks for
/// it (95th percentile, a chord error of half the tolerance).
[[nodiscard]] double fitting_spacing(const Program& program, const ProgrammedSurface& laid, double tolerance);

/// Stretches of all passes, in the order of the program. O(points).
[[nodiscard]] std::vector<Stretch> resample(const Program& program, const ProgrammedSurface& laid, const LineEditor& editor, const ResampleRules& rules);

}  // namespace clsurf

#pragma once
// Resampling: new points for sections of a program, aligned with the adjacent passes, on the smoothest path
// inside a tube around the programmed lines.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "numeric/bezier_curve.h"
#include "repair/line_edit.h"
#include "repair/points/line_rules.h"
#include "repair/points/orientation.h"
#include "surface/programmed_surface.h"

namespace clsurf {

struct ResampleRules {
    double tolerance = 0.005;    ///< [mm] largest distance from the programmed path, rounding included
    double spacing = 0;          ///< [mm] of arc length between points where the path bends most; 0: fitting_spacing()
    double chord_error = 0.001;  ///< [mm] from lines to curve; where it bends less, lines are 2, 4 or 8 spacings long
    double shortest_line =
        0;  ///< [mm] for the selection of aligned points: a controller slows down for blocks that it cannot read in time
    double most_turned = 0;  ///< [rad] largest error of the tool axis, rounding included
    bool splines = false;    ///< sections become splines if the dialect has them; three axes
    EndLines ends{};         ///< at the ends of passes
};

/// Motions first … last (lines that may be rewritten, on one pass) and the points that replace their ends. The last point is
/// their end.
struct ResampledSegment {
    std::int64_t first = 0, last = 0;
    std::vector<Vec3> points;          ///< [mm]
    std::vector<LineAngles> angles{};  ///< one per point; none in programs without rotary axes
    std::optional<Nurbs> spline{};  ///< spline that needs fewer blocks than the old lines; nullopt: lines to the points
};

/// The spacing of lines where the path bends most [mm]: for a chord error at the 98th percentile of curvature, between
/// a fifth of the usual spacing of the program and the whole of it.
[[nodiscard]] double fitting_spacing(const Program& program, const ProgrammedSurface& programmed, double chord_error);

/// The median length of the lines of the cut passes [mm].
[[nodiscard]] double usual_spacing(const Program& program, const ProgrammedSurface& programmed);

/// Sections of all passes, in the order of the program. `needed`: one entry per motion, 0 if it must not change; empty: all
/// may. `orientation`: of a program that is run on five axes; otherwise nullptr, and angles do not change. The tool axis at a
/// new point is that of its projection onto the old lines. O(points), parallel.
[[nodiscard]] std::vector<ResampledSegment> resample(const Program& program, const ProgrammedSurface& programmed,
                                                     const LineEditor& editor, const ResampleRules& wanted,
                                                     std::span<const std::uint8_t> needed,
                                                     const Orientation* orientation = nullptr);

}  // namespace clsurf

#pragma once
// ProgrammedSurface: the CL surface of a program without a log: its passes, and for each of its points the
// adjacent places on both sides. The rules are those for logs (surface/passes.h, surface/adjacency.h), but the
// points are on the programmed path.

#include <cstdint>
#include <vector>

#include "mapping/line_map.h"
#include "surface/cl_surface.h"

namespace clsurf {

struct ProgrammedSurface {
    ClSurface surface;
    std::vector<std::uint32_t> motion;  ///< per point: its motion
    std::vector<std::uint8_t> is_end;   ///< per point: 1 at the end of its motion

    [[nodiscard]] std::uint32_t motion_of(PointIndex point) const { return motion[static_cast<std::size_t>(point)]; }
    [[nodiscard]] bool ends_motion(PointIndex point) const { return is_end[static_cast<std::size_t>(point)] != 0; }
};

/// Points at the ends of all motions and evenly inside motions longer than half a step-over. Coordinates that the
/// program never sets count as 0. O(points); memory: bounded by 20 million points; beyond that, long motions get
/// fewer.
[[nodiscard]] ProgrammedSurface build_programmed_surface(const Program& program);

/// The line of each of its points.
[[nodiscard]] LineMap lines_of(const ProgrammedSurface& programmed, const Program& program);

/// The motions of a cut pass in order, as their end points; the first point is the start of the pass.
struct ProgrammedPass {
    std::int64_t number = 0;       ///< of the cut passes, from 1
    PointRange points;             ///< of the surface
    std::vector<PointIndex> ends;  ///< points of the surface: the first point, and the ends of motions
};

/// All cut passes with at least two points. O(points).
[[nodiscard]] std::vector<ProgrammedPass> cut_passes(const ProgrammedSurface& programmed);

}  // namespace clsurf

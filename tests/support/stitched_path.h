#pragma once
// Surfaces of made paths (support/made_path.h).

#include <utility>

#include "support/made_path.h"
#include "surface/cl_surface.h"
#include "toolpath/arc_length.h"

namespace clsurf::test {

inline ClSurface surface_of(Positions positions, double step_over) {
    ClSurface surface;
    const ArcLength arc_length(positions);
    surface.passes = find_passes(positions, arc_length, one_run(positions), step_over);
    surface.neighbours = find_neighbours(positions, surface.passes, arc_length, step_over);
    surface.positions = std::move(positions);
    surface.step_over = step_over;
    return surface;
}

}  // namespace clsurf::test

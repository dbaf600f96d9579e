#pragma once
// MeshPanel: a painted mesh on a rectangle of a picture.

#include <cstdint>
#include <vector>

#include "core/column.h"
#include "viz/colour_map.h"
#include "viz/flat.h"
#include "viz/geometry.h"
#include "viz/view.h"

namespace clsurf::viz {

struct MeshPanel {
    Rect rect;
    Camera camera;      ///< of the panel's size
    Geometry geometry;  ///< painted; where there is a ramp, its colours are darkened by `rgb`
    /// Colours along a ramp, so that what lies between two vertices is a colour of the ramp too, and
    /// not a mixture of two of its colours.
    std::vector<Rgb> ramp;  ///< empty: `rgb` alone
    Column<float> along;    ///< per vertex, 0 … 1; outside, the nearest end
    Column<float> pale;     ///< per vertex, 0: the ramp's colour; 1: a lighter tone of it; empty: 0
    bool stepped = false;   ///< the ramp's colours are steps; otherwise they run into each other
    /// Cells with a corner that has no value: triangles hatched, the others in one colour.
    Column<std::uint32_t> bare_triangles, bare_segments, bare_points;
    Rgb bare_colour{0, 0, 0};        ///< of the hatching's lines, and of the other cells
    Rgb bare_ground{255, 255, 255};  ///< between the lines
    double line_width = 1.5;
    double point_size = 2;
};

}  // namespace clsurf::viz

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
    Camera camera;      ///< camera with the panel's size
    Geometry geometry;  ///< painted; with a ramp, `rgb` only darkens the colours of the ramp
    /// Colours along a ramp, so that points between two vertices also have a colour of the ramp,
    /// not a mixture of the colours of the vertices.
    std::vector<Rgb> ramp;  ///< empty: only `rgb`
    Column<float> along;    ///< per vertex, 0 … 1; clamped
    Column<float> pale;     ///< per vertex, 0: the ramp's colour; 1: a lighter tone of it; empty: 0
    bool stepped = false;   ///< the ramp's colours are steps; otherwise they are interpolated
    /// Cells with a corner without a value: triangles are hatched, the others have one colour.
    Column<std::uint32_t> bare_triangles, bare_segments, bare_points;
    Rgb bare_colour{0, 0, 0};        ///< colour of hatching lines, and of the other cells
    Rgb bare_ground{255, 255, 255};  ///< colour between the lines
    double line_width = 1.5;
    double point_size = 2;
};

}  // namespace clsurf::viz

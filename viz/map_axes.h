#pragma once
// MapAxes: millimetres round a map, so that places can be read off it: a frame with ticks where two axes lie in the
// picture, a box with three scales otherwise.

#include <string>

#include "viz/depth_buffer.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Whether two axes of the workpiece lie in the picture: top, bottom, front, back, left, right.
[[nodiscard]] bool has_frame(const Look& look);
/// Whether a box is drawn: other views, unless they are zoomed.
[[nodiscard]] bool has_box(const Look& look);
/// A part of the picture only.
[[nodiscard]] bool is_zoomed(const Look& look);

/// What a panel leaves free for its ticks and their labels [px].
struct AxesRoom {
    double left = 0, bottom = 0, right = 0, top = 0;
};
[[nodiscard]] AxesRoom axes_room(const Look& look, const MapLayout& layout);

/// Frame or box of what is shown of `part` [mm]. `frame` names the coordinates, "G54"; it may be empty. `depth`: what the
/// part hides, of a panel whose geometry came in parts; nullptr: of its geometry. `room` [mm] lies between the part and its
/// box, in X and Y.
void add_scales(Sheet& sheet, const MeshPanel& panel, const Box3& part, const std::string& frame, const Look& look,
                const MapLayout& layout, const DepthBuffer* depth = nullptr, double room = 0);

}  // namespace clsurf::viz

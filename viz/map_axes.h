#pragma once
// MapAxes: scales in millimetres around a map: a frame with ticks if two axes are parallel to the
// picture, otherwise a box with three scales.

#include <string>

#include "viz/depth_buffer.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Whether two axes of the workpiece are parallel to the picture: top, bottom, front, back, left, right.
[[nodiscard]] bool has_frame(const Look& look);
/// Whether a box is drawn: other views, unless they are zoomed.
[[nodiscard]] bool has_box(const Look& look);
/// Whether only a part of the picture is shown.
[[nodiscard]] bool is_zoomed(const Look& look);

/// The margins of a panel for its ticks and their labels [px].
struct AxesRoom {
    double left = 0, bottom = 0, right = 0, top = 0;
};
[[nodiscard]] AxesRoom axes_room(const Look& look, const MapLayout& layout);

/// Draws the frame or box around the shown part of `part` [mm]. `frame` names the coordinates, "G54"; it may be empty.
/// `depth`: what the part hides, for a panel whose geometry came in parts; nullptr: computed from its geometry. `room` [mm]
/// is the distance between the part and its box, in X and Y.
void add_scales(Sheet& sheet, const MeshPanel& panel, const Box3& part, const std::string& frame, const Look& look,
                const MapLayout& layout, const DepthBuffer* depth = nullptr, double room = 0);

}  // namespace clsurf::viz

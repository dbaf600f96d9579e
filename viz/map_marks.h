#pragma once
// Marks on a map: points, lines of the program, outlines of defects.

#include "viz/map_layout.h"

namespace clsurf::viz {

/// Draws the marks of a map on its panel. Black with a white edge is visible on every colour. Labels do not overlap: each
/// is placed where there is room, with a line to its mark. Returns the number of labels without room.
[[nodiscard]] int add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look,
                            const MapLayout& layout);

}  // namespace clsurf::viz

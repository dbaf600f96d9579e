#pragma once
// What is marked on a map: points, lines of the program, outlines of defects.

#include "viz/map_layout.h"

namespace clsurf::viz {

/// Those of a map, on its panel. Black on a white edge is seen on every colour. No label lies on another one: it stands
/// where there is room, with a line to what it names. Returns the number of labels for which there is none.
[[nodiscard]] int add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look,
                            const MapLayout& layout);

}  // namespace clsurf::viz

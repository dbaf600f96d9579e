#pragma once
// MapMarks: what is marked on a map: points, lines of the program, outlines of defects.

#include "viz/map_layout.h"

namespace clsurf::viz {

/// Those of a map, on its panel. Black on a white edge is seen on every colour.
void add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const MapLayout& layout);

}  // namespace clsurf::viz

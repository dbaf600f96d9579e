#pragma once
// The sections at fault drawn along their passes, as wide as the step-over, and the column of their names.

#include "viz/defect_map.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Draws the marks of map.defects on its panel, and in `room` their names: beside the panel with lines that do not cross, in
/// a tall picture as a table below it, with the numbers of the strongest on the part. The rest of the room says how many
/// more there are, what colours mean, and what dotted means. Returns how many of the table's numbers have no room on the part.
int add_defects(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Rect& room, const Look& look,
                const MapLayout& layout);

}  // namespace clsurf::viz

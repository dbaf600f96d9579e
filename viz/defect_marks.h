#pragma once
// Sections with defects drawn along their passes, as wide as the step-over, and the column of their names.

#include "viz/defect_map.h"
#include "viz/map_layout.h"

namespace clsurf::viz {

/// Draws the marks of map.defects on its panel, and their names in `room`: next to the part with lines that do not cross, or
/// in a tall picture as a table below it, with the numbers of the strongest on the part. The rest of the room says how many
/// more there are, and what colours and dotted lines mean. Returns how many numbers of the table have no room on the part.
int add_defects(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Rect& room, const Look& look,
                const MapLayout& layout);

}  // namespace clsurf::viz

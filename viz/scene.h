#pragma once
// Scene: a quality map on a sheet: panels, the items around them (map_margin.h) and the marks on
// them (map_marks.h). To draw something new, add a function that adds it to the sheet.

#include <functional>
#include <optional>
#include <vector>

#include "viz/drawn_parts.h"
#include "viz/map_panel.h"
#include "viz/placed_map.h"

namespace clsurf::viz {

/// The sheet of one map, or of two next to each other with the same scale; `placed`: placed_map() of them.
[[nodiscard]] Sheet map_sheet(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                              const MapTexts& texts, const Look& look);

/// Draws it. Throws SystemError, UsageError.
[[nodiscard]] Image draw_map(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                             const MapTexts& texts, const Look& look);

/// Some passes of a surface, and their surroundings (surface/surface_part.h). Every cell is in exactly one part.
struct PanelPart {
    MapPanel panel;  ///< surface, field and pale points of the part
    PointRange own;  ///< points of the part: only cells made at them are drawn (DetailRequest::own)
};

/// Draws the parts of a map without classes that next() gives, one at a time; nothing: no more parts. `whole` is the
/// panel of the whole map, and `placed` is placed_map() of it. Throws SystemError.
[[nodiscard]] DrawnParts draw_parts(const MapPanel& whole, const std::function<std::optional<PanelPart>()>& next,
                                    const PlacedMap& placed, const ColourScale& scale, const Look& look);

/// The map of all parts, byte for byte equal to draw_map() of the whole, with the marks of `whole`. Throws SystemError,
/// UsageError.
[[nodiscard]] Image draw_map(const DrawnParts& parts, const MapPanel& whole, const PlacedMap& placed,
                             const ColourScale& scale, MapTexts texts, const Look& look);

}  // namespace clsurf::viz

#pragma once
// Scene: a quality map on a sheet: panels, what stands round them (map_margin.h), what is marked on
// them (map_marks.h). To draw another thing, add a function that puts it on the sheet.

#include <functional>
#include <optional>
#include <vector>

#include "viz/drawn_parts.h"
#include "viz/map_panel.h"
#include "viz/placed_map.h"

namespace clsurf::viz {

/// The sheet of one map, or of two side by side on one scale; `placed` is placed_map() of them.
[[nodiscard]] Sheet map_sheet(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                              const MapTexts& texts, const Look& look);

/// Draws it. Throws SystemError, UsageError.
[[nodiscard]] Image draw_map(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                             const MapTexts& texts, const Look& look);

/// Some passes of a surface, and what lies beside them (surface/surface_part.h). All parts together have every cell once.
struct PanelPart {
    MapPanel panel;  ///< surface, field and pale points of the part
    PointRange own;  ///< points of the part: what is made at them is drawn (DetailRequest::own)
};

/// Draws the parts of a map without classes that next() gives, one at a time; nothing: there are no more. `whole` is the
/// panel of the whole map, and `placed` is placed_map() of it. Throws SystemError.
[[nodiscard]] DrawnParts draw_parts(const MapPanel& whole, const std::function<std::optional<PanelPart>()>& next,
                                    const PlacedMap& placed, const ColourScale& scale, const Look& look);

/// The map of all of its parts, byte for byte that of draw_map() of the whole, with the marks of `whole`. Throws SystemError,
/// UsageError.
[[nodiscard]] Image draw_map(const DrawnParts& parts, const MapPanel& whole, const PlacedMap& placed,
                             const ColourScale& scale, MapTexts texts, const Look& look);

}  // namespace clsurf::viz

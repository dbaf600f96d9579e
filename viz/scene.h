#pragma once
// Scene: a quality map on a sheet: panels, what stands round them (map_margin.h), what is marked on
// them (map_marks.h). To draw another thing, add a function that puts it on the sheet.

#include <functional>
#include <optional>
#include <vector>

#include "viz/map_panel.h"
#include "viz/placed_map.h"

namespace clsurf::viz {

/// The sheet of one map, or of two side by side on one scale; `placed` is placed_map() of them.
[[nodiscard]] Sheet map_sheet(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                              const MapTexts& texts, const Look& look);

/// Draws it. Throws SystemError, UsageError.
[[nodiscard]] Image draw_map(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                             const MapTexts& texts, const Look& look);

/// Some passes of a surface, and what lies beside them (surface/surface_part.h).
struct PanelPart {
    MapPanel panel;                              ///< surface, field and pale points of the part
    const Column<PointIndex>* points = nullptr;  ///< of the whole surface, by point of the part
    PointRange own;                              ///< cells that begin at these points of the whole are drawn
};

/// A map whose surface is in memory in parts, one at a time. All parts together have every cell once.
struct MapInParts {
    /// Without classes. Of its surface step-over and origin are read, and `extent`; the places of marked points and lines, too.
    MapPanel whole;
    std::function<std::optional<PanelPart>()> next;  ///< nothing: there are no more
    std::function<MapTexts()> texts;                 ///< asked for after the last part
};

/// Draws it: the same picture as draw_map() of the whole. `placed` is placed_map() of the whole. Throws SystemError,
/// UsageError.
[[nodiscard]] Image draw_map(const MapInParts& map, const PlacedMap& placed, const ColourScale& scale,
                             const Look& look);

}  // namespace clsurf::viz

#pragma once
// Scene: a quality map on a sheet: panels, what stands round them (map_margin.h), what is marked on
// them (map_marks.h). To draw another thing, add a function that puts it on the sheet.

#include <vector>

#include "viz/map_panel.h"

namespace clsurf::viz {

/// Extent along the axes of a view of the points that do not belong to rapids [mm]. O(points), parallel.
[[nodiscard]] Box3 extent_of(const ClSurface& surface, const ViewAxes& axes);

/// What the map panels show: a camera of the panels' size. What the part fills of the box,
/// where there is one, else all that is drawn.
[[nodiscard]] Camera map_camera(const std::vector<MapPanel>& panels, const Look& look);

/// The sheet of one map, or of two side by side on one scale; `camera` is map_camera's.
[[nodiscard]] Sheet map_sheet(const std::vector<MapPanel>& panels, const Camera& camera, const ColourScale& scale,
                              const MapTexts& texts, const Look& look);

/// Draws it. Throws SystemError, UsageError.
[[nodiscard]] Image draw_map(const std::vector<MapPanel>& panels, const Camera& camera, const ColourScale& scale,
                             const MapTexts& texts, const Look& look);

}  // namespace clsurf::viz

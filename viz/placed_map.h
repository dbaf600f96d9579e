#pragma once
// PlacedMap: the positions of the panels and texts of a map on the sheet, and its camera.

#include <vector>

#include "viz/map_layout.h"
#include "viz/map_panel.h"

namespace clsurf::viz {

constexpr double caption_lines = 1.6;  ///< height of a panel's caption, in text sizes

/// The layout of a map and the camera of its panels.
struct PlacedMap {
    MapLayout layout;
    Camera camera;
};

/// The extent of the surface or the height map of a panel along the axes of a view [mm]. O(points), parallel.
[[nodiscard]] Box3 extent_of_panel(const MapPanel& map, const ViewAxes& axes);

/// Selects the arrangement in which the part is largest, among those that fit the shape of the picture. The camera has the
/// size of the panels, and shows the part inside Look::box, if there is one, otherwise everything. O(points), parallel.
[[nodiscard]] PlacedMap placed_map(const std::vector<MapPanel>& panels, const Look& look);

/// The position of panel k [px]: at the left or the top if names follow; otherwise centred in the area without the legend.
[[nodiscard]] Rect panel_rect(const std::vector<MapPanel>& panels, std::size_t k, const Look& look,
                              const PlacedMap& placed);

/// The area of legend or names, to the right of the `last` panel or below it [px].
[[nodiscard]] Rect legend_rect(const std::vector<MapPanel>& panels, const Rect& last, const Look& look,
                               const PlacedMap& placed);

}  // namespace clsurf::viz

#pragma once
// PlacedMap: where the panels of a map and its words stand on the sheet, and what its camera sees.

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

/// Of the surface or the relief of a panel along the axes of a view [mm]. O(points), parallel.
[[nodiscard]] Box3 extent_of_panel(const MapPanel& map, const ViewAxes& axes);

/// Of the arrangements that fit the shape of the picture, the one in which the part is largest. The camera has the size of
/// the panels, and sees what the part fills of Look::box, where there is one, else all that is drawn. O(points), parallel.
[[nodiscard]] PlacedMap placed_map(const std::vector<MapPanel>& panels, const Look& look);

/// Where panel k is [px]: at the left or the top, where names follow; a map in the middle of what its legend leaves.
[[nodiscard]] Rect panel_rect(const std::vector<MapPanel>& panels, std::size_t k, const Look& look,
                              const PlacedMap& placed);

/// Where legend or names stand, right of the `last` panel or below it [px].
[[nodiscard]] Rect legend_rect(const std::vector<MapPanel>& panels, const Rect& last, const Look& look,
                               const PlacedMap& placed);

}  // namespace clsurf::viz

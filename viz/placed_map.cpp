#include "viz/placed_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "viz/height_map.h"
#include "viz/map_axes.h"
#include "viz/surface_extent.h"

namespace clsurf::viz {
namespace {

/// Panels next to each other; a caption has a line above its panel, ticks have room at the left and below.
Rect widest_rect(const std::vector<MapPanel>& panels, std::size_t k, const Look& look, const MapLayout& layout) {
    const Rect area = layout.map_area(look);
    const auto count = static_cast<double>(panels.size());
    const double caption = panels[k].caption.empty() ? 0 : caption_lines * layout.text;
    const AxesRoom room = has_frame(look) ? axes_room(look, layout) : AxesRoom{};
    return {std::round(area.x + area.width * static_cast<double>(k) / count + room.left),
            std::round(area.y + room.bottom), std::max(1.0, std::floor(area.width / count - room.left - room.right)),
            std::max(1.0, std::floor(area.height - room.bottom - room.top) - std::ceil(caption))};
}

/// The shown extent of a part.
struct Framing {
    bool boxed = false;  ///< a box is drawn: `box` is along the workpiece axes; otherwise along those of the view
    Box3 box;            ///< [mm]
};

Framing framing_of(const std::vector<MapPanel>& panels, const Look& look) {
    const auto extent = [&](const ViewAxes& axes) {
        Box3 all;
        for (const MapPanel& map : panels) all.extend(extent_of_panel(map, axes));
        return all;
    };
    const bool boxed = has_box(look);
    if (look.box.isEmpty()) return {boxed, extent(boxed ? ViewAxes(ViewAxes::Identity()) : axes_of(look.view))};
    // If the given box is larger than the part, for example along Z, the extent of the part counts.
    const Box3 filled = look.box.intersection(extent(ViewAxes::Identity()));
    const Box3& shown = filled.isEmpty() ? look.box : filled;
    return {boxed, boxed ? shown : extent_along(axes_of(look.view), shown)};
}

/// `most`, or the size of a part of `needed` pixels with a margin [px].
int shrunk(int most, double needed, double margin) {
    return std::isfinite(needed) ? std::min(most, static_cast<int>(std::ceil(margin * std::max(needed, 1.0)))) : most;
}

/// The largest panel of an arrangement. It is made smaller if names or a legend would be far from the part.
PlacedMap placed_map(Arrangement arrangement, const std::vector<MapPanel>& panels, const Framing& framing,
                     const Look& look) {
    constexpr double margin_for_leaders = 1.4, usual_margin = 1.08;
    const MapLayout layout(look, arrangement);
    const Rect rect = widest_rect(panels, 0, look, layout);
    const auto width = static_cast<int>(rect.width);
    const auto height = static_cast<int>(rect.height);
    // The scales of a box are inside the panel.
    const AxesRoom room = framing.boxed ? axes_room(look, layout) : AxesRoom{};
    const int across = std::max(1, static_cast<int>(width - room.left - room.right));
    const int up = std::max(1, static_cast<int>(height - room.bottom - room.top));
    Camera camera = framing.boxed ? camera_for(look.view, framing.box, across, up, look.zoom)
                                  : camera_for(axes_of(look.view), framing.box, across, up, look.zoom);
    camera.width = width;
    camera.height = height;
    if (!look.legend || is_zoomed(look) || framing.box.isEmpty()) return {layout, camera};
    const Vec3 size = framing.box.sizes() / camera.mm_per_pixel;
    const double wide = framing.boxed ? camera.right.cwiseAbs().dot(size) + room.left + room.right : size.x();
    const double high = framing.boxed ? camera.up.cwiseAbs().dot(size) + room.bottom + room.top : size.y();
    const bool leaders = panels.front().defects != nullptr && arrangement != Arrangement::tall;
    if (leaders)
        camera.width = shrunk(width, wide, margin_for_leaders);
    else if (arrangement == Arrangement::wide && panels.size() == 1)
        camera.width = shrunk(width, wide, usual_margin);
    if (arrangement == Arrangement::tall) camera.height = shrunk(height, high, usual_margin);
    return {layout, camera};
}

}  // namespace

Box3 extent_of_panel(const MapPanel& map, const ViewAxes& axes) {
    return map.height_map != nullptr ? extent_of(*map.height_map, axes) : extent_of(*map.surface, axes);
}

PlacedMap placed_map(const std::vector<MapPanel>& panels, const Look& look) {
    constexpr double tall_picture = 1.2;  // height over width
    constexpr double clearly = 0.97;
    const Framing framing = framing_of(panels, look);
    PlacedMap best = placed_map(Arrangement::usual, panels, framing, look);
    if (!look.legend || is_zoomed(look)) return best;
    const auto consider = [&](Arrangement arrangement) {
        PlacedMap other = placed_map(arrangement, panels, framing, look);
        if (other.camera.mm_per_pixel < clearly * best.camera.mm_per_pixel) best = std::move(other);
    };
    if (is_wide(look)) consider(Arrangement::wide);
    if (look.height > tall_picture * look.width) consider(Arrangement::tall);
    return best;
}

Rect panel_rect(const std::vector<MapPanel>& panels, std::size_t k, const Look& look, const PlacedMap& placed) {
    constexpr double share_above = 0.4;  // share of the unused height of a tall picture
    Rect rect = widest_rect(panels, k, look, placed.layout);
    const double beside = rect.width - placed.camera.width;
    const double above = rect.height - placed.camera.height;
    const bool names = panels.front().defects != nullptr;
    if (!names && placed.layout.arrangement == Arrangement::wide) rect.x += std::floor(0.5 * beside);
    rect.y += names ? above : std::ceil((1 - share_above) * above);
    rect.width = placed.camera.width;
    rect.height = placed.camera.height;
    return rect;
}

Rect legend_rect(const std::vector<MapPanel>& panels, const Rect& last, const Look& look, const PlacedMap& placed) {
    const MapLayout& layout = placed.layout;
    const AxesRoom room = has_frame(look) ? axes_room(look, layout) : AxesRoom{};
    if (layout.arrangement == Arrangement::tall)
        return {0, layout.note_height, static_cast<double>(look.width), last.y - room.bottom - layout.note_height};
    const Rect widest = widest_rect(panels, panels.size() - 1, look, layout);
    const double x = look.width - layout.legend_width - (widest.x + widest.width - last.x - last.width);
    if (layout.arrangement == Arrangement::wide)
        return {x, layout.margin, look.width - x, look.height - 2 * layout.margin};
    return {x, layout.note_height, look.width - x, look.height - layout.title_height - layout.note_height};
}

}  // namespace clsurf::viz

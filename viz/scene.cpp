#include "viz/scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/block.h"
#include "core/point_ranges.h"
#include "viz/defect_marks.h"
#include "viz/map_axes.h"
#include "viz/map_margin.h"
#include "viz/map_marks.h"
#include "viz/mesh_painter.h"

namespace clsurf::viz {
namespace {

constexpr double shade_dark = 0.80;   ///< brightness of a surface in grazing light
constexpr double grey_dark = 0.62;    ///< brightness of a grey surface, which shows only its shade
constexpr double path_width = 3;      ///< [px] width of passes without adjacent ones
constexpr double path_room = 8;       ///< [px] distance between such a path and its box
constexpr double grey_light = 232;    ///< brightness of a grey surface that faces the light
const Vec3 light(-0.45, 0.55, 0.70);  ///< from the upper left, in the camera's frame

/// Sets the position of vertices on the ramp, and their shade in grazing light.
Beyond paint(Detail& detail, const ColourScale& scale, double per_inside, const Rgb& background, MeshPanel& panel) {
    Geometry& g = detail.geometry;
    const Camera& camera = panel.camera;
    const std::size_t count = detail.values.size();
    g.rgb.resize(3 * count);
    panel.along.resize(count);
    panel.ramp = scale.ramp();
    panel.stepped = scale.bins > 0;
    panel.bare_colour = missing_colour;
    panel.bare_ground = background;
    const Vec3 direction = (light.x() * camera.right + light.y() * camera.up + light.z() * camera.towards).normalized();
    const bool lit = !g.normals.empty();
    std::atomic<bool> below{false};
    std::atomic<bool> above{false};
    std::atomic<bool> missing{false};
    parallel_for(static_cast<std::int64_t>(count), block_points, [&](std::int64_t first, std::int64_t last) {
        Beyond here;
        for (std::int64_t i = first; i < last; ++i) {
            const auto v = static_cast<std::size_t>(i);
            const double value = detail.values[v] * per_inside;
            const bool known = value == value;
            panel.along[v] = known ? static_cast<float>(scale.along(value)) : 0.0F;
            here.missing = here.missing || !known;
            here.below = here.below || scale.is_below(value);
            here.above = here.above || scale.is_above(value);
            double shade = 1;
            if (lit) {
                const Vec3 n(g.normals[3 * v], g.normals[3 * v + 1], g.normals[3 * v + 2]);
                shade = shade_dark + (1 - shade_dark) * std::abs(n.dot(direction));
            }
            const auto grey = static_cast<std::uint8_t>(std::lround(255 * shade));
            for (std::size_t k = 0; k < 3; ++k) g.rgb[3 * v + k] = grey;
        }
        if (here.below) below = true;
        if (here.above) above = true;
        if (here.missing) missing = true;
    });
    g.normals = {};
    return {below, above, missing};
}

/// 1 at vertices in one of the ranges, which increase.
Column<float> paleness_of(const Column<PointIndex>& points, const std::vector<PointRange>& ranges) {
    Column<float> pale(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) pale[v] = any_has(ranges, points[v]) ? 1.0F : 0.0F;
    return pale;
}

/// Removes and returns the cells of `size` corners with a corner without a value.
Column<std::uint32_t> take_bare(Column<std::uint32_t>& cells, std::size_t size, const Column<float>& values) {
    Column<std::uint32_t> bare;
    std::size_t kept = 0;
    for (std::size_t i = 0; i + size <= cells.size(); i += size) {
        bool known = true;
        for (std::size_t k = 0; k < size; ++k) known = known && values[cells[i + k]] == values[cells[i + k]];
        for (std::size_t k = 0; k < size; ++k) {
            if (known)
                cells[kept++] = cells[i + k];
            else
                bare.push_back(cells[i + k]);
        }
    }
    cells.resize(kept);
    return bare;
}

}  // namespace

namespace {

/// Grey: only the shade of the surface, without values.
void paint_grey(Detail& detail, MeshPanel& panel) {
    Geometry& g = detail.geometry;
    const Camera& camera = panel.camera;
    const Vec3 direction = (light.x() * camera.right + light.y() * camera.up + light.z() * camera.towards).normalized();
    g.rgb.resize(g.xyz.size());
    for (unsigned char& c : g.rgb) c = static_cast<unsigned char>(grey_light);
    if (g.normals.empty()) return;
    parallel_for(static_cast<std::int64_t>(g.xyz.size() / 3), block_points, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) {
            const auto v = 3 * static_cast<std::size_t>(i);
            const Vec3 n(g.normals[v], g.normals[v + 1], g.normals[v + 2]);
            const double shade = grey_dark + (1 - grey_dark) * std::abs(n.dot(direction));
            for (std::size_t k = 0; k < 3; ++k) g.rgb[v + k] = static_cast<std::uint8_t>(grey_light * shade);
        }
    });
    g.normals = {};
}

/// No pass has an adjacent one: only lines are drawn.
bool is_path(const MapPanel& map) { return map.height_map == nullptr && map.surface->step_over <= 0; }

/// The shown extent of a part.
Box3 shown_box(const MapPanel& map, const Look& look) {
    const Box3 all = extent_of_panel(map, ViewAxes::Identity());
    return look.box.isEmpty() ? all : all.intersection(look.box);
}

Beyond paint_panel(Detail& detail, const MapPanel& map, const ColourScale& scale, const Look& look, MeshPanel& panel) {
    if (map.defects != nullptr) {
        paint_grey(detail, panel);
        return {};
    }
    if (map.classes == nullptr) return paint(detail, scale, map.field->info.unit.per_inside, look.background, panel);
    divide_by_class(detail, map.field->values, *map.classes);
    return paint(detail, scale, 1, look.background, panel);
}

/// The visible detail of a panel with a margin: a triangle across its edge has corners outside.
Detail detail_of(const MapPanel& map, const Camera& camera, const Look& look, const PointRange& own) {
    const double room =
        std::min(2.0 * map.surface->step_over / camera.mm_per_pixel + 8.0, static_cast<double>(camera.width));
    DetailRequest request;
    request.projection = camera.projection();
    request.projection.col(3).array() += std::ceil(room);
    request.width = camera.width + 2 * static_cast<int>(std::ceil(room));
    request.height = camera.height + 2 * static_cast<int>(std::ceil(room));
    request.style = look.style;
    request.box = look.box;
    request.own = own;
    return map.height_map != nullptr ? height_map_detail(*map.height_map, map.field->values, request)
                                     : visible_detail(*map.surface, map.field->values, request);
}

/// Whether shown cutting points of a map have values beyond the range. Vertices cannot show this: the mean of the points in a
/// pixel hides a few such values.
Beyond beyond_of_points(const MapPanel& map, const ColourScale& scale, const Look& look, const Camera& camera,
                        const PointRange& own) {
    Beyond beyond;
    const double unit = map.field->info.unit.per_inside;
    for (const Pass& pass : map.surface->passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = std::max(pass.first, own.first); i <= std::min(pass.last, own.last); ++i) {
            const double value = map.field->values[static_cast<std::size_t>(i)] * unit;
            const bool is_new = (scale.is_below(value) && !beyond.below) || (scale.is_above(value) && !beyond.above);
            if (!is_new || !shows(camera, look, map.surface->positions.absolute(i))) continue;
            beyond.widen({scale.is_below(value), scale.is_above(value), false});
        }
        if (beyond.below && beyond.above) break;
    }
    return beyond;
}

/// Paints the visible detail of a map on a panel with rectangle and camera. `own`: the range of a map in parts.
Beyond fill_panel(const MapPanel& map, const ColourScale& scale, const Look& look, MeshPanel& panel,
                  const PointRange& own = DetailRequest().own) {
    Detail detail = detail_of(map, panel.camera, look, own);
    Beyond here = paint_panel(detail, map, scale, look, panel);
    if (map.defects == nullptr && map.classes == nullptr && map.height_map == nullptr)
        here.widen(beyond_of_points(map, scale, look, panel.camera, own));
    if (!map.pale.empty()) panel.pale = paleness_of(detail.points, map.pale);
    panel.geometry = std::move(detail.geometry);
    if (is_path(map)) panel.line_width = path_width;
    if (here.missing) {
        panel.bare_triangles = take_bare(panel.geometry.triangles, 3, detail.values);
        panel.bare_segments = take_bare(panel.geometry.segments, 2, detail.values);
        panel.bare_points = take_bare(panel.geometry.points, 1, detail.values);
    }
    return here;
}

/// Thin lines behind the points or lines of a log, in one colour, as cells of the mesh, so that the log covers them. If the
/// log is shown as a surface, they are lines over it (map_marks.h).
void add_programmed_below(const MapPanel& map, const Look& look, MeshPanel& panel) {
    if (map.programmed == nullptr || map.height_map != nullptr || look.style == Style::surface) return;
    Geometry& g = panel.geometry;
    const Vec3 behind = -0.05 * map.surface->step_over * panel.camera.towards - g.origin;
    const auto add = [&](const Vec3& p) {
        const Vec3 at = p + behind;
        for (Eigen::Index k = 0; k < 3; ++k) g.xyz.push_back(static_cast<float>(at[k]));
        for (const std::uint8_t c : missing_colour) g.rgb.push_back(c);
        panel.along.push_back(0);
        if (!panel.pale.empty()) panel.pale.push_back(0);
        panel.bare_segments.push_back(static_cast<std::uint32_t>(g.xyz.size() / 3 - 1));
    };
    const auto inside = [&](const Vec3& p) { return look.box.isEmpty() || look.box.contains(p); };
    for (const std::vector<Vec3>& corners : *map.programmed) {
        for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
            const Vec3 &from = corners[k], &to = corners[k + 1];
            if (!inside(from) || !inside(to)) continue;
            if (!shows(panel.camera, look, from) && !shows(panel.camera, look, to)) continue;
            add(from);
            add(to);
        }
    }
}

Sheet empty_sheet(const Look& look) {
    Sheet sheet;
    sheet.width = look.width;
    sheet.height = look.height;
    sheet.background = look.background;
    sheet.keep_drawing = look.keep_drawing;
    return sheet;
}

/// Scales in millimetres for a panel, and the axes next to the last one.
void add_scales_of(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const std::string& frame, bool last,
                   const Look& look, const MapLayout& layout, const DepthBuffer* depth = nullptr) {
    if (!look.legend) return;
    const Rgb ink = ink_for(look.background);
    // Without room, lines of the box would cover those of a path along its edges.
    const double room = is_path(map) && look.box.isEmpty() ? path_room * panel.camera.mm_per_pixel : 0;
    add_scales(sheet, panel, shown_box(map, look), frame, look, layout, depth, room);
    if (!last || has_frame(look)) return;
    add_axes(sheet, panel, look, layout, ink);
    if (!has_box(look)) add_scale_bar(sheet, panel, layout, ink);
}

/// Title, notes and the legend of colours. `legend`: its area.
void add_words(Sheet& sheet, const MapPanel& map, const ColourScale& scale, const MapTexts& texts, const Beyond& beyond,
               const Rect& legend, const Look& look, const MapLayout& layout) {
    if (!look.legend) return;
    const Rgb ink = ink_for(look.background);
    // The key of a defect map extends down to the notes; the axes are at the right edge.
    const bool key = map.defects != nullptr && layout.arrangement != Arrangement::tall;
    add_title(sheet, texts, key ? look.width - legend.x : layout.margin + 3.5 * layout.text, look, layout, ink);
    if (map.classes != nullptr)
        add_class_legend(sheet, map.classes->shown(), beyond.missing, legend, look, layout, ink);
    else if (map.defects == nullptr)
        add_legend(sheet, scale, map.field->info, beyond, legend, look, layout, ink);
}

void note_labels_without_room(int count, MapTexts& texts) {
    if (count > 0)
        texts.notes.push_back(count == 1 ? "1 label does not fit in this picture"
                                         : fmt::format("{} labels do not fit in this picture", count));
}

}  // namespace

Sheet map_sheet(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
                const MapTexts& texts, const Look& look) {
    const MapLayout& layout = placed.layout;
    const Rgb ink = ink_for(look.background);
    Sheet sheet = empty_sheet(look);
    const Rect legend = legend_rect(panels, panel_rect(panels, panels.size() - 1, look, placed), look, placed);
    Beyond beyond;
    int without_room = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const MapPanel& map = panels[k];
        MeshPanel panel;
        panel.rect = panel_rect(panels, k, look, placed);
        panel.camera = placed.camera;  // each panel shows the same part at the same scale
        beyond.widen(fill_panel(map, scale, look, panel));
        add_programmed_below(map, look, panel);
        if (map.defects != nullptr) without_room += add_defects(sheet, map, panel, legend, look, layout);
        without_room += add_marks(sheet, map, panel, look, layout);
        if (!map.caption.empty()) {
            // The name of the vertical axis is above the frame.
            const double above = has_frame(look) ? axes_room(look, layout).top : 0;
            const double y = panel.rect.y + panel.rect.height + above + 0.5 * caption_lines * layout.text;
            sheet.texts.push_back(
                fitted({panel.rect.x + layout.margin, y, map.caption, layout.text, Align::left, true, ink},
                       panel.rect.width - 2 * layout.margin));
        }
        add_scales_of(sheet, map, panel, texts.frame, k + 1 == panels.size(), look, layout);
        sheet.panels.push_back(std::move(panel));
    }
    MapTexts all = texts;
    note_labels_without_room(without_room, all);
    add_words(sheet, panels.back(), scale, all, beyond, legend, look, layout);
    return sheet;
}

DrawnParts draw_parts(const MapPanel& whole, const std::function<std::optional<PanelPart>()>& next,
                      const PlacedMap& placed, const ColourScale& scale, const Look& look) {
    const std::unique_ptr<MeshPainter> painter = make_mesh_painter(look.width, look.height, look.gl, look.supersample);
    DrawnParts drawn{painter->empty(), DepthBuffer(placed.camera), {}};
    while (const std::optional<PanelPart> part = next()) {
        MeshPanel panel;
        panel.rect = panel_rect({whole}, 0, look, placed);
        panel.camera = placed.camera;
        drawn.beyond.widen(fill_panel(part->panel, scale, look, panel, part->own));
        if (has_box(look)) drawn.depth.add(panel.geometry);
        painter->draw(panel, drawn.samples);
    }
    return drawn;
}

Image draw_map(const DrawnParts& parts, const MapPanel& whole, const PlacedMap& placed, const ColourScale& scale,
               MapTexts texts, const Look& look) {
    const std::vector<MapPanel> panels{whole};
    MeshPanel frame;
    frame.rect = panel_rect(panels, 0, look, placed);
    frame.camera = placed.camera;
    Sheet sheet = empty_sheet(look);
    note_labels_without_room(add_marks(sheet, whole, frame, look, placed.layout), texts);
    add_scales_of(sheet, whole, frame, texts.frame, true, look, placed.layout, &parts.depth);
    add_words(sheet, whole, scale, texts, parts.beyond, legend_rect(panels, frame.rect, look, placed), look,
              placed.layout);
    return draw(sheet, parts.samples, look.gl, look.supersample);
}

Image draw_map(const std::vector<MapPanel>& panels, const PlacedMap& placed, const ColourScale& scale,
               const MapTexts& texts, const Look& look) {
    return draw(map_sheet(panels, placed, scale, texts, look), look.gl, look.supersample);
}

}  // namespace clsurf::viz

#include "viz/scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/block.h"

namespace clsurf::viz {
namespace {

constexpr double caption_lines = 1.6;   ///< height of a panel's caption, in text sizes
constexpr double shade_dark = 0.80;  ///< of a surface that the light only grazes
const Vec3 light(-0.45, 0.55, 0.70);  ///< from the upper left, in the camera's frame

/// Sizes of the layout, from the picture's size.
struct Layout {
    double text, small_text, margin, title_height, note_height, legend_width;
    explicit Layout(const Look& look) {
        text = std::clamp(std::min(look.width * 0.75, look.height * 1.0) / 46.0, 9.0, 60.0);
        small_text = std::max(8.0, 0.78 * text);
        margin = 0.8 * text;
        title_height = 3.6 * text;
        note_height = 3.0 * small_text;
        legend_width = look.legend ? 7.2 * text : 0;
    }
};

Rgb ink_for(const Rgb& background) {
    const double lightness = 0.3 * background[0] + 0.59 * background[1] + 0.11 * background[2];
    return lightness > 128 ? Rgb{20, 20, 24} : Rgb{240, 240, 240};
}
Rgb faint(const Rgb& ink, const Rgb& background) {
    Rgb mixed;
    for (std::size_t k = 0; k < 3; ++k) mixed[k] = static_cast<std::uint8_t>((2 * ink[k] + background[k]) / 3);
    return mixed;
}

/// What the colours of a map leave out: values beyond the range by more than can be read off it.
struct Beyond {
    bool below = false, above = false, missing = false;
};

/// Vertices get their places on the ramp, and the shade of light that grazes.
Beyond paint(Detail& detail, const ColourScale& scale, double per_inside, MeshPanel& panel) {
    Geometry& g = detail.geometry;
    const Camera& camera = panel.camera;
    const std::size_t count = detail.values.size();
    g.rgb.resize(3 * count);
    panel.along.resize(count);
    panel.ramp = scale.ramp();
    panel.stepped = scale.bins > 0;
    panel.bare_colour = missing_colour;
    const Vec3 direction = (light.x() * camera.right + light.y() * camera.up + light.z() * camera.towards).normalized();
    const bool lit = !g.normals.empty();
    const double readable = 0.005 * (scale.high - scale.low);
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
            here.below = here.below || value < scale.low - readable;
            here.above = here.above || value > scale.high + readable;
            double shade = 1;
            if (lit) {
                const Vec3 n(g.normals[3 * v], g.normals[3 * v + 1], g.normals[3 * v + 2]);
                shade = shade_dark + (1 - shade_dark) * std::abs(n.dot(direction));
            }
            for (std::size_t k = 0; k < 3; ++k) g.rgb[3 * v + k] = static_cast<std::uint8_t>(255 * shade + 0.5);
        }
        if (here.below) below = true;
        if (here.above) above = true;
        if (here.missing) missing = true;
    });
    g.normals = {};
    return {below, above, missing};
}

/// Takes the cells of `size` corners out of which one has no value.
Column<std::uint32_t> take_bare(Column<std::uint32_t>& cells, std::size_t size, const Column<float>& values) {
    Column<std::uint32_t> bare;
    std::size_t kept = 0;
    for (std::size_t i = 0; i + size <= cells.size(); i += size) {
        bool known = true;
        for (std::size_t k = 0; k < size; ++k) known = known && values[cells[i + k]] == values[cells[i + k]];
        for (std::size_t k = 0; k < size; ++k) {
            if (known) cells[kept++] = cells[i + k];
            else bare.push_back(cells[i + k]);
        }
    }
    cells.resize(kept);
    return bare;
}

void add_text(Sheet& sheet, double x, double y, std::string text, double size, Align align, Rgb rgb, bool bold = false) {
    sheet.texts.push_back({x, y, std::move(text), size, align, bold, rgb});
}

void add_title(Sheet& sheet, const MapTexts& texts, const Look& look, const Layout& layout, Rgb ink) {
    const double width = look.width - 2 * layout.margin;
    const double top = look.height - layout.margin;
    sheet.texts.push_back(fitted({layout.margin, top - 0.5 * layout.text, texts.title, 1.25 * layout.text, Align::left, true, ink}, width));
    sheet.texts.push_back(fitted({layout.margin, top - 2.0 * layout.text, texts.subtitle, layout.small_text, Align::left, false, faint(ink, look.background)}, width));
    const double note_width = 0.72 * (look.width - layout.legend_width) - layout.margin;
    FlatText note{layout.margin, layout.margin * 0.5 + 0.5 * layout.small_text, "", layout.small_text, Align::left, false, faint(ink, look.background)};
    // From the top: a line takes as many notes as fit; there is room for two.
    constexpr std::size_t most_lines = 2;
    std::vector<FlatText> lines;
    for (const std::string& part : texts.notes) {
        FlatText longer = note;
        longer.text = lines.empty() ? part : lines.back().text + "; " + part;
        if (!lines.empty() && (lines.size() == most_lines || text_width(longer) <= note_width)) {
            lines.back() = std::move(longer);
            continue;
        }
        lines.push_back(note);
        lines.back().text = part;
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k].y += 1.25 * layout.small_text * static_cast<double>(lines.size() - 1 - k);
        sheet.texts.push_back(fitted(std::move(lines[k]), note_width));
    }
}

/// Beyond an end of the bar there are values: a point of the end's colour.
void add_beyond(Sheet& sheet, const ColourScale& scale, bool above, double x, double width, double y, double height, Rgb frame) {
    const Rgb rgb = scale.colour(above ? scale.high : scale.low);
    const double sign = above ? 1 : -1;
    constexpr int slices = 24;
    for (int k = 0; k < slices; ++k) {
        const double part = 1 - (k + 0.5) / slices;
        const double low = sign > 0 ? y + height * k / slices : y - height * (k + 1) / slices;
        sheet.quads.push_back({{x + 0.5 * width * (1 - part), low, width * part, height / slices + 0.3}, rgb});
    }
    sheet.lines.push_back({{{x, y}, {x + 0.5 * width, y + sign * height}, {x + width, y}}, 1.0, frame});
}

/// Round values; where the colours are steps, their edges, as many as have room.
std::vector<double> legend_ticks(const ColourScale& scale, int wanted) {
    if (!(scale.high > scale.low)) return {scale.low};
    if (scale.bins == 0) return nice_ticks(scale.low, scale.high, std::max(2, wanted));
    std::vector<double> edges;
    const int each = (scale.bins - 1) / std::max(2, 2 * wanted) + 1;
    for (int k = each; k < scale.bins; k += each) edges.push_back(scale.low + (scale.high - scale.low) * k / scale.bins);
    return edges;
}

void add_legend(Sheet& sheet, const ColourScale& scale, const FieldInfo& field, const Beyond& beyond, const Look& look, const Layout& layout, Rgb ink) {
    const double x = look.width - layout.legend_width + 0.6 * layout.text;
    const double bar_width = 1.3 * layout.text;
    const double bottom = layout.note_height + 7.2 * layout.text;
    const double top = look.height - layout.title_height - 2.6 * layout.text;
    const double height = top - bottom;
    if (height < 3 * layout.text) return;
    const int cells = scale.bins > 0 ? scale.bins : static_cast<int>(std::clamp(height, 16.0, 512.0));
    for (int k = 0; k < cells; ++k) {
        const double value = scale.low + (scale.high - scale.low) * (k + 0.5) / cells;
        sheet.quads.push_back({{x, bottom + height * k / cells, bar_width, height / cells + 0.6}, scale.colour(value)});
    }
    const Rgb frame = faint(ink, look.background);
    sheet.lines.push_back({{{x, bottom}, {x + bar_width, bottom}, {x + bar_width, top}, {x, top}, {x, bottom}}, 1.0, frame});
    const std::vector<double> ticks = legend_ticks(scale, static_cast<int>(height / (3 * layout.text)));
    double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    if (scale.bins > 0) step /= 10;  // the edges of steps are not round
    // The ends of the range stand there exactly; ticks too near to them give way.
    const double near = 1.3 * layout.small_text / height * (scale.high - scale.low);
    for (const double end : {scale.low, scale.high}) {
        if (!(scale.high > scale.low) && end == scale.high) continue;
        const double y = end == scale.low ? bottom : top;
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, tick_text(end, scale.bins > 0 ? step : step / 10), layout.small_text, Align::left, ink, true);
    }
    for (const double tick : ticks) {
        if (tick - scale.low < near || scale.high - tick < near) continue;
        const double t = scale.high > scale.low ? (tick - scale.low) / (scale.high - scale.low) : 0.5;
        const double y = bottom + t * height;
        sheet.lines.push_back({{{x + bar_width, y}, {x + bar_width + 0.3 * layout.text, y}}, 1.0, frame});
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, tick_text(tick, step), layout.small_text, Align::left, ink);
    }
    const double point = 0.9 * layout.text;
    if (beyond.above) add_beyond(sheet, scale, true, x, bar_width, top, point, frame);
    if (beyond.below) add_beyond(sheet, scale, false, x, bar_width, bottom, point, frame);
    const std::string unit = field.unit.name.empty() ? std::string() : fmt::format("[{}]", field.unit.name);
    add_text(sheet, x, top + 2.1 * layout.text, unit, layout.text, Align::left, ink, true);
    if (beyond.missing) {
        const double y = bottom - 2.0 * layout.text;
        sheet.quads.push_back({{x, y - 0.4 * layout.text, bar_width, 0.8 * layout.text}, missing_colour});
        add_text(sheet, x + bar_width + 0.5 * layout.text, y, "no value", layout.small_text, Align::left, ink);
    }
}

/// A bar of a round length, true in the whole picture since the projection is parallel.
void add_scale_bar(Sheet& sheet, const MeshPanel& panel, const Layout& layout, Rgb ink) {
    const double wanted = 0.22 * panel.rect.width * panel.camera.mm_per_pixel;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    double length = power;
    for (const double factor : {2.0, 5.0}) {
        if (factor * power <= wanted) length = factor * power;
    }
    const double pixels = length / panel.camera.mm_per_pixel;
    const double x = panel.rect.x + panel.rect.width - layout.margin - pixels;
    const double y = 0.55 * layout.margin + 0.2 * layout.text;
    const double tick = 0.35 * layout.text;
    sheet.lines.push_back({{{x, y + tick}, {x, y - tick}}, 1.5, ink});
    sheet.lines.push_back({{{x, y}, {x + pixels, y}}, 1.5, ink});
    sheet.lines.push_back({{{x + pixels, y + tick}, {x + pixels, y - tick}}, 1.5, ink});
    add_text(sheet, x + 0.5 * pixels, y + 0.9 * layout.text, fmt::format("{:g} mm", length), layout.small_text, Align::centre, ink);
}

void add_axes(Sheet& sheet, const MeshPanel& panel, const Layout& layout, Rgb ink) {
    // Below the legend, where no map can be under it.
    const Vec2 origin(panel.rect.x + panel.rect.width + 0.42 * layout.legend_width, 3.4 * layout.text);
    const double length = 2.0 * layout.text;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 direction = Vec3::Unit(axis);
        const Vec2 flat(direction.dot(panel.camera.right), direction.dot(panel.camera.up));
        if (flat.norm() < 0.15) continue;  // it points at the eye
        static constexpr Rgb colours[3] = {{200, 40, 40}, {30, 140, 50}, {40, 80, 200}};
        sheet.lines.push_back({{origin, origin + length * flat}, 2.0, colours[axis]});
        const Vec2 at = origin + (length + 0.55 * layout.text) * flat.normalized() * std::max(0.5, flat.norm());
        add_text(sheet, at.x(), at.y(), std::string(1, "XYZ"[axis]), layout.small_text, Align::centre, ink);
    }
}

void add_ring(Sheet& sheet, const Vec2& at, double radius, double width, Rgb rgb, bool under) {
    FlatLine ring{{}, width, rgb, under};
    constexpr int pieces = 48;
    for (int k = 0; k <= pieces; ++k) {
        const double a = 2 * std::numbers::pi * k / pieces;
        ring.points.emplace_back(at + radius * Vec2(std::cos(a), std::sin(a)));
    }
    sheet.lines.push_back(std::move(ring));
}

/// The parts of a line that are in the picture.
std::vector<std::vector<Vec2>> strokes(const std::vector<Vec3>& corners, const Camera& camera, const Look& look, const Vec2& corner) {
    std::vector<std::vector<Vec2>> all;
    bool goes_on = false;
    for (const Vec3& p : corners) {
        if (!shows(camera, look, p)) {
            goes_on = false;
            continue;
        }
        if (!goes_on) all.emplace_back();
        goes_on = true;
        all.back().push_back(corner + camera.pixel(p));
    }
    std::erase_if(all, [](const std::vector<Vec2>& stroke) { return stroke.size() < 2; });
    return all;
}

/// Outlines with their numbers above them; a number that would lie on another is left out.
void add_outlines(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const Layout& layout) {
    const Vec2 corner(panel.rect.x, panel.rect.y);
    constexpr Rgb white{255, 255, 255};
    constexpr Rgb black{0, 0, 0};
    std::vector<Rect> taken;
    for (const OutlineMark& mark : map.outlines) {
        Vec2 top(0, -1);
        for (const std::vector<Vec3>& corners : mark.lines) {
            for (std::vector<Vec2>& stroke : strokes(corners, panel.camera, look, corner)) {
                for (const Vec2& p : stroke) {
                    if (p.y() > top.y()) top = p;
                }
                sheet.lines.push_back({stroke, 0.2 * layout.text, white, true});
                sheet.lines.push_back({std::move(stroke), 0.08 * layout.text, black, false});
            }
        }
        if (top.y() < 0 || mark.label.empty()) continue;
        FlatText text{top.x(), top.y() + 0.75 * layout.small_text, mark.label, layout.small_text, Align::centre, true, black};
        const double width = text_width(text) + 6;
        text.x = std::clamp(text.x, corner.x() + 0.5 * width, corner.x() + panel.rect.width - 0.5 * width);
        const Rect box{text.x - 0.5 * width, text.y - 0.62 * layout.small_text, width, 1.24 * layout.small_text};
        const bool overlaps = std::any_of(taken.begin(), taken.end(), [&](const Rect& other) {
            return box.x < other.x + other.width && other.x < box.x + box.width && box.y < other.y + other.height && other.y < box.y + box.height;
        });
        if (overlaps) continue;
        taken.push_back(box);
        sheet.quads.push_back({box, white});
        sheet.texts.push_back(std::move(text));
    }
}

/// The parts of a line that are in the picture.
std::vector<std::vector<Vec2>> strokes(const PointRange& range, const ClSurface& surface, const Camera& camera, const Look& look, const Vec2& corner) {
    std::vector<std::vector<Vec2>> all;
    bool goes_on = false;
    for (PointIndex i = range.first; i <= range.last; ++i) {
        const Vec3 p = surface.positions.absolute(i);
        if (!shows(camera, look, p)) {
            goes_on = false;
            continue;
        }
        const Vec2 at = corner + camera.pixel(p);
        if (!goes_on) all.emplace_back();
        goes_on = true;
        if (all.back().empty() || (at - all.back().back()).norm() >= 0.5) all.back().push_back(at);
    }
    for (std::vector<Vec2>& stroke : all) {
        if (stroke.size() == 1) stroke.push_back(stroke[0] + Vec2(0.5, 0));
    }
    return all;
}

/// Black on a white edge is seen on every colour.
void add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const Layout& layout) {
    const Vec2 corner(panel.rect.x, panel.rect.y);
    constexpr Rgb white{255, 255, 255};
    constexpr Rgb black{0, 0, 0};
    const auto label = [&](Vec2 at, const std::string& text) {
        if (text.empty()) return;
        FlatText flat{at.x() + 0.9 * layout.text, at.y() + 0.9 * layout.text, text, layout.small_text, Align::left, true, black};
        const double width = text_width(flat);
        const double right = corner.x() + panel.rect.width;
        if (flat.x + width > right) flat.x = std::max(corner.x(), at.x() - 0.9 * layout.text - width);
        sheet.quads.push_back({{flat.x - 2, flat.y - 0.65 * layout.small_text, width + 4, 1.3 * layout.small_text}, white});
        sheet.texts.push_back(std::move(flat));
    };
    for (const LineMark& mark : map.lines) {
        bool labelled = false;
        for (const PointRange& range : mark.points) {
            for (std::vector<Vec2>& stroke : strokes(range, *map.surface, panel.camera, look, corner)) {
                if (!labelled) label(stroke.front(), mark.label);
                labelled = true;
                sheet.lines.push_back({stroke, 0.35 * layout.text, white, true});
                sheet.lines.push_back({std::move(stroke), 0.17 * layout.text, black, false});
            }
            // The first point of a marked line is ringed: there the line begins.
            if (const Vec3 p = map.surface->positions.absolute(range.first); shows(panel.camera, look, p)) {
                add_ring(sheet, corner + panel.camera.pixel(p), 0.45 * layout.text, 0.15 * layout.text, black, false);
            }
        }
    }
    add_outlines(sheet, map, panel, look, layout);
    for (const PointMark& mark : map.points) {
        const Vec3 p = map.surface->positions.absolute(mark.point);
        if (!shows(panel.camera, look, p)) continue;
        const Vec2 at = corner + panel.camera.pixel(p);
        add_ring(sheet, at, 0.75 * layout.text, 0.36 * layout.text, white, true);
        add_ring(sheet, at, 0.75 * layout.text, 0.18 * layout.text, black, false);
        label(at, mark.label);
    }
}

}  // namespace

bool shows(const Camera& camera, const Look& look, const Vec3& p) {
    return p.allFinite() && camera.shows(p) && (look.box.isEmpty() || look.box.contains(p));
}

Box3 extent_of(const ClSurface& surface, const ViewAxes& axes) {
    const Positions& p = surface.positions;
    const Eigen::Matrix3f turned = axes.cast<float>();
    struct Piece {
        PointIndex first, last;
        Eigen::AlignedBox3f box;
    };
    std::vector<Piece> pieces;
    for (const Pass& pass : surface.passes) {
        if (pass.kind == PassKind::rapid) continue;
        for (PointIndex first = pass.first; first <= pass.last; first += block_points) {
            pieces.push_back({first, std::min(pass.last, first + block_points - 1), {}});
        }
    }
    parallel_for(static_cast<std::int64_t>(pieces.size()), 8, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            Piece& piece = pieces[static_cast<std::size_t>(k)];
            // A point that is not finite neither widens nor empties the box.
            Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
            Eigen::Array3f high = -low;
            for (PointIndex i = piece.first; i <= piece.last; ++i) {
                const Eigen::Vector3f q = turned * p[i];
                if (!q.allFinite()) continue;
                low = low.min(q.array());
                high = high.max(q.array());
            }
            if ((low <= high).all()) piece.box = Eigen::AlignedBox3f(low.matrix(), high.matrix());
        }
    });
    Eigen::AlignedBox3f box;
    for (const Piece& piece : pieces) box.extend(piece.box);
    if (box.isEmpty()) return {};
    const Vec3 origin = axes * p.origin;
    return {box.min().cast<double>() + origin, box.max().cast<double>() + origin};
}

namespace {

Rect map_area(const Look& look, const Layout& layout) {
    Rect area{0, 0, look.width - layout.legend_width, static_cast<double>(look.height)};
    if (!look.legend) return area;
    area.y = layout.note_height;
    area.height -= layout.note_height + layout.title_height;
    return area;
}

/// Panels side by side; a caption has its own line above.
Rect panel_rect(const std::vector<MapPanel>& panels, std::size_t k, const Look& look, const Layout& layout) {
    const Rect area = map_area(look, layout);
    const auto count = static_cast<double>(panels.size());
    const double caption = panels[k].caption.empty() ? 0 : caption_lines * layout.text;
    return {std::round(area.x + area.width * static_cast<double>(k) / count), std::round(area.y),
            std::max(1.0, std::floor(area.width / count)), std::max(1.0, std::floor(area.height) - std::ceil(caption))};
}

}  // namespace

Camera map_camera(const std::vector<MapPanel>& panels, const Look& look) {
    const Rect rect = panel_rect(panels, 0, look, Layout(look));
    const auto width = static_cast<int>(rect.width);
    const auto height = static_cast<int>(rect.height);
    const auto extent = [&](const ViewAxes& axes) {
        Box3 all;
        for (const MapPanel& map : panels) all.extend(map.relief != nullptr ? extent_of(*map.relief, axes) : extent_of(*map.surface, axes));
        return all;
    };
    if (look.box.isEmpty()) {
        const ViewAxes axes = axes_of(look.view);
        return camera_for(axes, extent(axes), width, height, look.zoom);
    }
    // Where the box is larger than the part, as one may give it along Z, the part is what counts.
    const Box3 filled = look.box.intersection(extent(ViewAxes::Identity()));
    return camera_for(look.view, filled.isEmpty() ? look.box : filled, width, height, look.zoom);
}

Sheet map_sheet(const std::vector<MapPanel>& panels, const Camera& camera, const ColourScale& scale, const MapTexts& texts, const Look& look) {
    const Layout layout(look);
    const Rgb ink = ink_for(look.background);
    Sheet sheet;
    sheet.width = look.width;
    sheet.height = look.height;
    sheet.background = look.background;
    Beyond beyond;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const MapPanel& map = panels[k];
        MeshPanel panel;
        panel.rect = panel_rect(panels, k, look, layout);
        panel.camera = camera;  // each panel shows the same part at the same scale
        DetailRequest request;
        // Somewhat more than the panel: a triangle over its edge has corners outside.
        const double room = std::min(2.0 * map.surface->step_over / camera.mm_per_pixel + 8.0, static_cast<double>(camera.width));
        request.projection = camera.projection();
        request.projection.col(3).array() += std::ceil(room);
        request.width = camera.width + 2 * static_cast<int>(std::ceil(room));
        request.height = camera.height + 2 * static_cast<int>(std::ceil(room));
        request.style = look.style;
        request.box = look.box;
        Detail detail = map.relief != nullptr ? relief_detail(*map.relief, map.field->values, request) : visible_detail(*map.surface, map.field->values, request);
        const Beyond here = paint(detail, scale, map.field->info.unit.per_inside, panel);
        beyond = {beyond.below || here.below, beyond.above || here.above, beyond.missing || here.missing};
        panel.geometry = std::move(detail.geometry);
        if (here.missing) {
            panel.bare_triangles = take_bare(panel.geometry.triangles, 3, detail.values);
            panel.bare_segments = take_bare(panel.geometry.segments, 2, detail.values);
            panel.bare_points = take_bare(panel.geometry.points, 1, detail.values);
        }
        add_marks(sheet, map, panel, look, layout);
        if (!map.caption.empty()) {
            const double y = panel.rect.y + panel.rect.height + 0.5 * caption_lines * layout.text;
            sheet.texts.push_back(fitted({panel.rect.x + layout.margin, y, map.caption, layout.text, Align::left, true, ink},
                                         panel.rect.width - 2 * layout.margin));
        }
        if (look.legend && k + 1 == panels.size()) {
            add_axes(sheet, panel, layout, ink);
            add_scale_bar(sheet, panel, layout, ink);
        }
        sheet.panels.push_back(std::move(panel));
    }
    if (look.legend) {
        add_title(sheet, texts, look, layout, ink);
        add_legend(sheet, scale, panels.front().field->info, beyond, look, layout, ink);
    }
    return sheet;
}

Image draw_map(const std::vector<MapPanel>& panels, const Camera& camera, const ColourScale& scale, const MapTexts& texts, const Look& look) {
    return draw(map_sheet(panels, camera, scale, texts, look), look.gl, look.supersample);
}

}  // namespace clsurf::viz

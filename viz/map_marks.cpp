#include "viz/map_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace clsurf::viz {
namespace {

void add_ring(Sheet& sheet, const Vec2& at, double radius, double width, Rgb rgb, bool under) {
    FlatLine ring{{}, width, rgb, under};
    constexpr int pieces = 48;
    for (int k = 0; k <= pieces; ++k) {
        const double a = 2 * std::numbers::pi * k / pieces;
        ring.points.emplace_back(at + radius * Vec2(std::cos(a), std::sin(a)));
    }
    sheet.lines.push_back(std::move(ring));
}

/// The parts of a line of `count` positions that are in the picture, in steps of half a pixel or more.
template <typename At>
std::vector<std::vector<Vec2>> strokes(PointIndex count, const At& position, const Camera& camera, const Look& look,
                                       const Vec2& corner) {
    std::vector<std::vector<Vec2>> all;
    bool goes_on = false;
    for (PointIndex i = 0; i < count; ++i) {
        const Vec3 p = position(i);
        if (!shows(camera, look, p)) {
            goes_on = false;
            continue;
        }
        const Vec2 at = corner + camera.pixel(p);
        if (!goes_on) all.emplace_back();
        goes_on = true;
        if (all.back().empty() || (at - all.back().back()).norm() >= 0.5) all.back().push_back(at);
    }
    return all;
}

/// Outlines with their numbers above them; a number that would lie on another is left out.
void add_outlines(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look,
                  const MapLayout& layout) {
    const Vec2 corner(panel.rect.x, panel.rect.y);
    constexpr Rgb white{255, 255, 255};
    constexpr Rgb black{0, 0, 0};
    std::vector<Rect> taken;
    for (const OutlineMark& mark : map.outlines) {
        Vec2 top(0, -1);
        for (const std::vector<Vec3>& corners : mark.lines) {
            const auto position = [&](PointIndex i) -> const Vec3& { return corners[static_cast<std::size_t>(i)]; };
            for (std::vector<Vec2>& stroke :
                 strokes(static_cast<PointIndex>(corners.size()), position, panel.camera, look, corner)) {
                if (stroke.size() < 2) continue;
                for (const Vec2& p : stroke) {
                    if (p.y() > top.y()) top = p;
                }
                sheet.lines.push_back({stroke, 0.2 * layout.text, white, true});
                sheet.lines.push_back({std::move(stroke), 0.08 * layout.text, black, false});
            }
        }
        if (top.y() < 0 || mark.label.empty()) continue;
        FlatText text{top.x(), top.y() + 0.75 * layout.small_text, mark.label, layout.small_text, Align::centre, true,
                      black};
        const double width = text_width(text) + 6;
        text.x = std::clamp(text.x, corner.x() + 0.5 * width, corner.x() + panel.rect.width - 0.5 * width);
        const Rect box{text.x - 0.5 * width, text.y - 0.62 * layout.small_text, width, 1.24 * layout.small_text};
        const bool overlaps = std::any_of(taken.begin(), taken.end(), [&](const Rect& other) {
            return box.x < other.x + other.width && other.x < box.x + box.width && box.y < other.y + other.height &&
                   other.y < box.y + box.height;
        });
        if (overlaps) continue;
        taken.push_back(box);
        sheet.quads.push_back({box, white});
        sheet.texts.push_back(std::move(text));
    }
}

}  // namespace

void add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const MapLayout& layout) {
    const Vec2 corner(panel.rect.x, panel.rect.y);
    constexpr Rgb white{255, 255, 255};
    constexpr Rgb black{0, 0, 0};
    const auto label = [&](Vec2 at, const std::string& text) {
        if (text.empty()) return;
        FlatText flat{
            at.x() + 0.9 * layout.text, at.y() + 0.9 * layout.text, text, layout.small_text, Align::left, true, black};
        const double width = text_width(flat);
        const double right = corner.x() + panel.rect.width;
        if (flat.x + width > right) flat.x = std::max(corner.x(), at.x() - 0.9 * layout.text - width);
        sheet.quads.push_back(
            {{flat.x - 2, flat.y - 0.65 * layout.small_text, width + 4, 1.3 * layout.small_text}, white});
        sheet.texts.push_back(std::move(flat));
    };
    for (const LineMark& mark : map.lines) {
        bool labelled = false;
        for (const PointRange& range : mark.points) {
            const auto position = [&](PointIndex i) { return map.surface->positions.absolute(range.first + i); };
            for (std::vector<Vec2>& stroke : strokes(range.size(), position, panel.camera, look, corner)) {
                if (stroke.size() == 1) stroke.push_back(stroke[0] + Vec2(0.5, 0));
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

}  // namespace clsurf::viz

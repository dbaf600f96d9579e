#include "viz/map_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viz/depth_buffer.h"
#include "viz/label_placer.h"

namespace clsurf::viz {
namespace {

constexpr double least_step = 0.5;  ///< [px] shortest step of a line: shorter steps are invisible

void add_ring(Sheet& sheet, const Vec2& at, double radius, double width, Rgb rgb, Level level) {
    FlatLine ring{{}, width, rgb, level};
    constexpr int pieces = 48;
    for (int k = 0; k <= pieces; ++k) {
        const double a = 2 * std::numbers::pi * k / pieces;
        ring.points.emplace_back(at + radius * Vec2(std::cos(a), std::sin(a)));
    }
    sheet.lines.push_back(std::move(ring));
}

/// The parts of a line of `count` positions that are in the picture, in steps of at least half a pixel.
template <typename At>
std::vector<std::vector<Vec2>> strokes(PointIndex count, const At& position, const Camera& camera, const Look& look,
                                       const Vec2& corner) {
    std::vector<std::vector<Vec2>> all;
    bool goes_on = false;
    for (PointIndex i = 0; i < count; ++i) {
        const Vec3& p = position(i);
        if (!shows(camera, look, p)) {
            goes_on = false;
            continue;
        }
        const Vec2 at = corner + camera.pixel(p);
        if (!goes_on) all.emplace_back();
        goes_on = true;
        if (all.back().empty() || (at - all.back().back()).norm() >= least_step) all.back().push_back(at);
    }
    return all;
}

/// Draws the marks of one map onto a sheet.
class MarkDrawer {
public:
    MarkDrawer(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const MapLayout& layout)
        : sheet_(sheet),
          map_(map),
          panel_(panel),
          look_(look),
          layout_(layout),
          corner_(panel.rect.x, panel.rect.y),
          placer_(panel.rect) {}

    int draw() {
        const bool over = look_.style == Style::surface || map_.height_map != nullptr;
        if (over && map_.programmed != nullptr && !map_.programmed->empty()) add_programmed(*map_.programmed);
        for (const PointMark& mark : map_.points) take_ring(place_of(mark.point));
        for (const LineMark& mark : map_.lines) {
            for (const PointRange& range : mark.points) take_ring(place_of(range.first));
        }
        for (const LineMark& mark : map_.lines) add_line(mark);
        for (const PointMark& mark : map_.points) add_point(mark);
        add_outlines();
        return without_room_;
    }

private:
    static constexpr double hiding_step_overs = 2;  ///< a surface at least this far above a line hides it
    static constexpr double label_lines = 1.24;     ///< height of a label, in text sizes
    static constexpr Rgb white{255, 255, 255};
    static constexpr Rgb black{0, 0, 0};

    [[nodiscard]] Vec3 place_of(PointIndex point) const {
        return map_.place_of ? map_.place_of(point) : map_.surface->positions.absolute(point);
    }

    [[nodiscard]] double ring_radius() const { return 0.75 * layout_.text; }

    /// Keeps labels off the ring of a point.
    void take_ring(const Vec3& place) {
        if (!shows(panel_.camera, look_, place)) return;
        const Vec2 at = corner_ + panel_.camera.pixel(place);
        const double r = ring_radius();
        placer_.take({at.x() - r, at.y() - r, 2 * r, 2 * r});
    }

    /// A label near its anchor, with its middle at `middle` if there is room; a line connects one that is farther away.
    void add_label(const Vec2& anchor, const Vec2& middle, const std::string& text) {
        FlatText flat{0, 0, text, layout_.small_text, Align::centre, true, black};
        const Vec2 size(text_width(flat) + 6, label_lines * layout_.small_text);
        const std::optional<Rect> rect = placer_.place(middle, size, anchor);
        if (!rect) {
            ++without_room_;
            return;
        }
        flat.x = rect->x + 0.5 * rect->width;
        flat.y = rect->y + 0.5 * rect->height;
        const Vec2 nearest = nearest_in(*rect, anchor);
        if ((Vec2(flat.x, flat.y) - middle).norm() > size.y()) {
            sheet_.lines.push_back({{anchor, nearest}, 0.2 * layout_.text, white, Level::edge});
            sheet_.lines.push_back({{anchor, nearest}, 0.06 * layout_.text, black, Level::line});
            placer_.take_line(anchor, nearest);
        }
        // The halo covers the outlines of other marks, which would cross the text.
        sheet_.lines.push_back(
            {{{rect->x, flat.y}, {rect->x + rect->width, flat.y}}, rect->height, white, Level::halo});
        sheet_.texts.push_back(std::move(flat));
    }

    /// To the right of a ring, or to the left if it does not fit.
    void add_label_at_side(const Vec2& at, const std::string& text) {
        if (text.empty()) return;
        const FlatText flat{0, 0, text, layout_.small_text, Align::left, true, black};
        const double aside = 0.9 * layout_.text + 0.5 * (text_width(flat) + 6);
        const bool fits = at.x() + 2 * aside <= corner_.x() + panel_.rect.width;
        add_label(at, at + Vec2(fits ? aside : -aside, 0.9 * layout_.text), text);
    }

    void add_line(const LineMark& mark) {
        bool labelled = false;
        for (const PointRange& range : mark.points) {
            const auto position = [&](PointIndex i) { return place_of(range.first + i); };
            for (std::vector<Vec2>& stroke : strokes(range.size(), position, panel_.camera, look_, corner_)) {
                if (stroke.size() == 1) stroke.push_back(stroke[0] + Vec2(0.5, 0));
                if (!labelled) add_label_at_side(stroke.front(), mark.label);
                labelled = true;
                sheet_.lines.push_back({stroke, 0.35 * layout_.text, white, Level::edge});
                sheet_.lines.push_back({std::move(stroke), 0.17 * layout_.text, black, Level::line});
            }
            // A ring marks the first point of a marked line.
            if (const Vec3 p = place_of(range.first); shows(panel_.camera, look_, p))
                add_ring(sheet_, corner_ + panel_.camera.pixel(p), 0.45 * layout_.text, 0.15 * layout_.text, black,
                         Level::line);
        }
    }

    void add_point(const PointMark& mark) {
        const Vec3 p = place_of(mark.point);
        if (!shows(panel_.camera, look_, p)) return;
        const Vec2 at = corner_ + panel_.camera.pixel(p);
        add_ring(sheet_, at, ring_radius(), 0.36 * layout_.text, white, Level::edge);
        add_ring(sheet_, at, ring_radius(), 0.18 * layout_.text, black, Level::line);
        add_label_at_side(at, mark.label);
    }

    /// Thin lines, except where the part hides them.
    void add_programmed(const std::vector<std::vector<Vec3>>& lines) {
        constexpr Rgb grey{70, 70, 70};
        const DepthBuffer depth(panel_.geometry, panel_.camera);
        const double tolerance = hiding_step_overs * map_.surface->step_over;
        const auto seen = [&](const Vec3& p) {
            return (look_.box.isEmpty() || look_.box.contains(p)) && !depth.hides(p, tolerance);
        };
        FlatLine stroke;
        const auto close = [&] {
            if (stroke.points.size() > 1) sheet_.lines.push_back(stroke);
            stroke = {{}, 0.04 * layout_.text, grey, Level::area, panel_.rect};
        };
        for (const std::vector<Vec3>& corners : lines) {
            close();
            for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
                const Vec3 &from = corners[k], &to = corners[k + 1];
                const bool near = shows(panel_.camera, look_, from) || shows(panel_.camera, look_, to);
                if (!near || !seen(from) || !seen(to)) {
                    close();
                    continue;
                }
                if (stroke.points.empty()) stroke.points.push_back(corner_ + panel_.camera.pixel(from));
                const Vec2 at = corner_ + panel_.camera.pixel(to);
                const bool goes_on = k + 2 < corners.size() && (at - stroke.points.back()).norm() < least_step;
                if (!goes_on) stroke.points.push_back(at);
            }
        }
        close();
    }

    /// Draws an outline and keeps labels off it. Returns its highest point; nothing: it is not in the picture.
    std::optional<Vec2> add_outline(const OutlineMark& mark) {
        std::optional<Vec2> top;
        for (const std::vector<Vec3>& corners : mark.lines) {
            const auto position = [&](PointIndex i) -> const Vec3& { return corners[static_cast<std::size_t>(i)]; };
            for (std::vector<Vec2>& stroke :
                 strokes(static_cast<PointIndex>(corners.size()), position, panel_.camera, look_, corner_)) {
                if (stroke.size() < 2) continue;
                for (std::size_t k = 0; k < stroke.size(); ++k) {
                    if (!top || stroke[k].y() > top->y()) top = stroke[k];
                    if (k > 0) placer_.take_line(stroke[k - 1], stroke[k]);
                }
                sheet_.lines.push_back({stroke, 0.2 * layout_.text, white, Level::edge});
                sheet_.lines.push_back({std::move(stroke), 0.08 * layout_.text, black, Level::line});
            }
        }
        return top;
    }

    /// Outlines with their numbers above them.
    void add_outlines() {
        constexpr double above = 6;  // [px] distance from an outline to its label
        std::vector<std::optional<Vec2>> tops;
        for (const OutlineMark& mark : map_.outlines) tops.push_back(add_outline(mark));
        for (std::size_t k = 0; k < tops.size(); ++k) {
            const std::string& label = map_.outlines[k].label;
            if (tops[k] && !label.empty())
                add_label(*tops[k], *tops[k] + Vec2(0, 0.5 * label_lines * layout_.small_text + above), label);
        }
    }

    Sheet& sheet_;
    const MapPanel& map_;
    const MeshPanel& panel_;
    const Look& look_;
    const MapLayout& layout_;
    Vec2 corner_;
    LabelPlacer placer_;
    int without_room_ = 0;
};

}  // namespace

int add_marks(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Look& look, const MapLayout& layout) {
    return MarkDrawer(sheet, map, panel, look, layout).draw();
}

}  // namespace clsurf::viz

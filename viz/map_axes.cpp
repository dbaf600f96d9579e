#include "viz/map_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "viz/colour_map.h"

namespace clsurf::viz {
namespace {

constexpr double tick_length = 0.4;      ///< in small text sizes, like all values below
constexpr double label_distance = 1.05;  ///< distance from an edge to the middle of a number
constexpr double between_ticks = 5.5;
constexpr double shortest_scale = 3.0;
constexpr double frame_gap = 0.6;  ///< distance between the part and its frame

/// The axis of the workpiece along a direction; −1: none.
int axis_along(const Vec3& direction) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(direction[axis]) > 1 - 1e-9) return axis;
    }
    return -1;
}

class ScaleDrawer {
public:
    ScaleDrawer(Sheet& sheet, const MeshPanel& panel, const Box3& part, const Look& look, const MapLayout& layout)
        : sheet_(sheet),
          panel_(panel),
          part_(part),
          size_(layout.small_text),
          margin_(layout.margin),
          background_(look.background),
          ink_(faint(ink_for(look.background), look.background)),
          corner_(panel.rect.x, panel.rect.y) {}

    void frame(const std::string& of) {
        const Camera& camera = panel_.camera;
        Vec2 low(1e30, 1e30);
        Vec2 high = -low;
        for (int k = 0; k < 8; ++k) {
            const Vec2 at = camera.pixel(part_.corner(static_cast<Box3::CornerType>(k)));
            low = low.cwiseMin(at);
            high = high.cwiseMax(at);
        }
        const double gap = frame_gap * size_;
        low = (low.array() - gap).max(0.0).matrix();
        high = (high.array() + gap).min(Eigen::Array2d(panel_.rect.width, panel_.rect.height)).matrix();
        const std::array<Vec2, 4> corners{low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
        line({corner_ + corners[0], corner_ + corners[1], corner_ + corners[2], corner_ + corners[3],
              corner_ + corners[0]});
        scale(place_of(corners[0]), place_of(corners[1]), axis_along(camera.right), Vec2(0, -1), of);
        scale(place_of(corners[0]), place_of(corners[3]), axis_along(camera.up), Vec2(-1, 0), of);
    }

    /// `room` [mm]: distance around the part in X and Y.
    void box(double room, const std::string& of, const DepthBuffer& depth) {
        const Vec3 aside(room, room, 0);
        const Box3 part(part_.min() - aside, part_.max() + aside);
        const Camera& camera = panel_.camera;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<std::pair<Vec3, Vec3>> outer;  // edges that no other edge crosses in the picture
            for (int k = 0; k < 4; ++k) {
                Vec3 from = part.min();
                const int b = (axis + 1) % 3;
                const int c = (axis + 2) % 3;
                if ((k & 1) != 0) from[b] = part.max()[b];
                if ((k & 2) != 0) from[c] = part.max()[c];
                Vec3 to = from;
                to[axis] = part.max()[axis];
                const bool near_b = ((k & 1) != 0) == (camera.towards[b] > 0);
                const bool near_c = ((k & 2) != 0) == (camera.towards[c] > 0);
                if (near_b && near_c) continue;  // the edge is in front of the part
                edge(from, to, depth);
                if (near_b || near_c) outer.emplace_back(from, to);
            }
            if (outer.size() < 2) continue;
            // X and Y below the part, Z to its left.
            const auto rank = [&](const std::pair<Vec3, Vec3>& e) {
                const Vec2 middle = camera.pixel(0.5 * (e.first + e.second));
                return axis == 2 ? middle.x() : middle.y();
            };
            const auto& chosen = rank(outer[0]) <= rank(outer[1]) ? outer[0] : outer[1];
            const Vec2 middle = camera.pixel(0.5 * (chosen.first + chosen.second));
            const Vec2 along = camera.pixel(chosen.second) - camera.pixel(chosen.first);
            Vec2 outwards = Vec2(-along.y(), along.x()).normalized();
            if (outwards.dot(middle - camera.pixel(part.center())) < 0) outwards = -outwards;
            scale(chosen.first, chosen.second, axis, outwards, of);
        }
    }

private:
    [[nodiscard]] Vec3 place_of(const Vec2& pixel) const {
        const Camera& c = panel_.camera;
        const Vec2 from_middle = (pixel - 0.5 * Vec2(c.width, c.height)) * c.mm_per_pixel;
        return c.centre + from_middle.x() * c.right + from_middle.y() * c.up;
    }

    void line(std::vector<Vec2> points) { sheet_.lines.push_back({std::move(points), 1.0, ink_, Level::area}); }

    /// Draws the visible parts of an edge.
    void edge(const Vec3& from, const Vec3& to, const DepthBuffer& depth) {
        constexpr double step = 2;  // [px]
        const double length = (panel_.camera.pixel(to) - panel_.camera.pixel(from)).norm();
        const int count = std::max(1, static_cast<int>(length / step));
        std::vector<Vec2> seen;
        for (int k = 0; k <= count; ++k) {
            const Vec3 place = from + (to - from) * k / count;
            if (!depth.hides(place, 1e-3 * (to - from).norm())) {
                seen.push_back(corner_ + panel_.camera.pixel(place));
                continue;
            }
            if (seen.size() > 1) line(std::move(seen));
            seen.clear();
        }
        if (seen.size() > 1) line(std::move(seen));
    }

    /// Ticks and numbers of one axis between two points, on the side `outwards` of the line.
    void scale(const Vec3& from, const Vec3& to, int axis, const Vec2& outwards, const std::string& of) {
        if (axis < 0) return;
        const Vec2 a = panel_.camera.pixel(from);
        const Vec2 b = panel_.camera.pixel(to);
        const double length = (b - a).norm();
        const double low = std::min(from[axis], to[axis]);
        const double high = std::max(from[axis], to[axis]);
        if (!(high >= low)) return;
        const int wanted = std::max(2, static_cast<int>(length / (between_ticks * size_)));
        std::vector<double> ticks = nice_ticks(low, high, wanted);
        if (ticks.size() < 2) ticks = nice_ticks(low, high, 2 * wanted);
        if (!(length > shortest_scale * size_) || ticks.size() < 2) {
            const bool steep = std::abs(outwards.x()) > std::abs(outwards.y());
            const Vec2 end = steep ? Vec2(a.y() > b.y() ? a : b) : Vec2(0.5 * (a + b));
            tell_range(corner_ + end + 1.1 * size_ * (steep ? Vec2(0, 1) : outwards), axis, low, high);
            return;
        }
        const double step = ticks[1] - ticks[0];
        // The numbers of a steep scale are next to it, otherwise below it.
        const bool beside = std::abs(outwards.x()) > 0.8;
        double widest = 0;
        for (const double tick : ticks) {
            const double share = (tick - from[axis]) / (to[axis] - from[axis]);
            const Vec2 at = corner_ + a + share * (b - a);
            line({at, at + tick_length * size_ * outwards});
            const Vec2 label = at + label_distance * size_ * outwards;
            FlatText text{label.x(), label.y(), tick_text(tick, step), size_, Align::centre, false, ink_};
            if (beside) text.align = outwards.x() < 0 ? Align::right : Align::left;
            if (beside) text.x = at.x() + (tick_length + 0.25) * size_ * (outwards.x() < 0 ? -1 : 1);
            const Rect rect = text_rect(text);
            widest = std::max(widest, rect.width);
            // At a corner two scales meet: "20" and "−10" would read as one number.
            if (!take(rect)) continue;
            add_words(std::move(text));
        }
        name_axis(corner_ + a, corner_ + b, axis, outwards, of, beside, widest);
    }

    /// Whether another number overlaps, or is closer at the left or right than the width of a digit.
    [[nodiscard]] bool meets_number(const Rect& rect) const {
        const double gap = 0.6 * size_;
        return std::any_of(numbers_.begin(), numbers_.end(), [&](const Rect& number) {
            return rect.x < number.x + number.width + gap && number.x < rect.x + rect.width + gap &&
                   rect.y < number.y + number.height && number.y < rect.y + rect.height;
        });
    }

    /// Reserves the rectangle of a number; false: it overlaps another one.
    bool take(const Rect& number) {
        if (meets_number(number)) return false;
        numbers_.push_back(number);
        return true;
    }

    /// "Z −0.4 to 0.1 mm" for a scale that is too short for numbers, or "Z 0.000 mm" for a flat part: the shown range of the
    /// part, without the room around it. If an edge of the box crosses the text, it is in the lower left corner of the map.
    void tell_range(const Vec2& middle, int axis, double scale_low, double scale_high) {
        const double low = std::max(scale_low, part_.min()[axis]);
        const double high = std::max(low, std::min(scale_high, part_.max()[axis]));
        const double step = 0.1 * (high - low);
        FlatText text{0, middle.y(), "", size_, Align::left, false, ink_};
        text.text = high > low ? fmt::format("{} {} to {} mm", "XYZ"[axis], tick_text(low, step), tick_text(high, step))
                               : fmt::format("{} {} mm", "XYZ"[axis], tick_text(low, 1e-3));
        const double width = text_width(text);
        const double left = std::max(corner_.x(), margin_);
        text.x = std::clamp(middle.x() - 0.5 * width, left, std::max(left, corner_.x() + panel_.rect.width - width));
        if (is_crossed(text_rect(text))) {
            text.x = left;
            text.y = corner_.y() + size_;
        }
        // Two such texts may overlap in a small picture.
        constexpr int most_lines = 4;
        for (int k = 0; k < most_lines && !take(text_rect(text)); ++k) text.y += 1.3 * size_;
        add_words(std::move(text));
    }

    /// Whether an edge runs through a rectangle. Edges have a point every two pixels.
    [[nodiscard]] bool is_crossed(const Rect& rect) const {
        return std::any_of(sheet_.lines.begin(), sheet_.lines.end(), [&](const FlatLine& edge) {
            return std::any_of(edge.points.begin(), edge.points.end(), [&](const Vec2& p) {
                return p.x() > rect.x && p.x() < rect.x + rect.width && p.y() > rect.y && p.y() < rect.y + rect.height;
            });
        });
    }

    /// "X [mm, G54]", clear of numbers: beyond them, in the middle between two ticks.
    void name_axis(const Vec2& a, const Vec2& b, int axis, const Vec2& outwards, const std::string& of, bool beside,
                   double widest) {
        const std::string words =
            fmt::format("{} [mm{}{}]", "XYZ"[axis], of.empty() ? "" : ", ", axis == 0 ? of : std::string());
        FlatText text{0, 0, axis == 0 ? words : fmt::format("{} [mm]", "XYZ"[axis]), size_, Align::centre, true, ink_};
        if (beside) {
            // Above the upper end, if its width fits there.
            const Vec2 top = a.y() > b.y() ? a : b;
            text.x = top.x() + outwards.x() * 0.5 * widest;
            text.y = top.y() + 1.1 * size_;
        } else {
            const Vec2 middle =
                0.5 * (a + b) + (label_distance + 1.35 + 0.5 * std::abs(outwards.x()) * 3) * size_ * outwards;
            text.x = middle.x();
            text.y = middle.y();
            constexpr int most_steps = 6;
            for (int k = 0; k < most_steps && meets_number(text_rect(text)); ++k) {
                text.x += 0.3 * size_ * outwards.x();
                text.y += 0.3 * size_ * outwards.y();
            }
        }
        add_words(std::move(text));
    }

    /// Edges of the box, and leaders to the names of defects, are interrupted behind a text.
    void add_words(FlatText text) {
        sheet_.lines.push_back(halo_of(text, background_));
        sheet_.texts.push_back(std::move(text));
    }

    Sheet& sheet_;
    const MeshPanel& panel_;
    const Box3& part_;
    double size_, margin_;  ///< [px]
    Rgb background_;
    Rgb ink_;
    Vec2 corner_;
    std::vector<Rect> numbers_;
};

}  // namespace

bool has_frame(const Look& look) {
    const ViewAxes axes = axes_of(look.view);
    return look.legend && look.scales && axis_along(axes.row(0).transpose()) >= 0 &&
           axis_along(axes.row(1).transpose()) >= 0;
}

bool is_zoomed(const Look& look) {
    const Zoom whole;
    return look.zoom.x0 > whole.x0 || look.zoom.y0 > whole.y0 || look.zoom.x1 < whole.x1 || look.zoom.y1 < whole.y1;
}

bool has_box(const Look& look) { return look.legend && look.scales && !has_frame(look) && !is_zoomed(look); }

AxesRoom axes_room(const Look& look, const MapLayout& layout) {
    const double t = layout.small_text;
    if (has_frame(look)) return {4.2 * t, 3.6 * t, 0.6 * t, 1.8 * t};
    if (has_box(look)) return {3.6 * t, 3.2 * t, 3.6 * t, 1.8 * t};
    return {};
}

void add_scales(Sheet& sheet, const MeshPanel& panel, const Box3& part, const std::string& frame, const Look& look,
                const MapLayout& layout, const DepthBuffer* depth, double room) {
    if (part.isEmpty()) return;
    ScaleDrawer drawer(sheet, panel, part, look, layout);
    if (has_frame(look))
        drawer.frame(frame);
    else if (has_box(look))
        drawer.box(room, frame, depth != nullptr ? *depth : DepthBuffer(panel.geometry, panel.camera));
}

}  // namespace clsurf::viz

#include "viz/label_placer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clsurf::viz {
namespace {

constexpr double cell = 3;             ///< [px]
constexpr double reach = 12;           ///< largest distance from the wanted position, in label heights
constexpr double ring_distance = 0.5;  ///< distance between rings of tried positions, in label heights
constexpr int tries_a_ring = 16;
constexpr double start_of_line = 2.5 * cell;  ///< [px] occupied by the label's own mark

/// Calls visit(point) in steps of a cell until a call returns false. Returns whether all calls returned true.
template <typename Visit>
bool every_place(const Vec2& from, const Vec2& to, Visit&& visit) {
    const int steps = 1 + static_cast<int>((to - from).norm() / cell);
    for (int k = 0; k <= steps; ++k) {
        if (!visit(Vec2(from + (to - from) * k / steps))) return false;
    }
    return true;
}

}  // namespace

Vec2 nearest_in(const Rect& rect, const Vec2& to) {
    return {std::clamp(to.x(), rect.x, rect.x + rect.width), std::clamp(to.y(), rect.y, rect.y + rect.height)};
}

LabelPlacer::LabelPlacer(const Rect& panel)
    : panel_(panel),
      columns_(static_cast<int>(std::ceil(panel.width / cell)) + 1),
      rows_(static_cast<int>(std::ceil(panel.height / cell)) + 1),
      taken_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false) {}

/// Calls visit(flag of a cell) until a call returns false. Returns whether all calls returned true.
template <typename Visit>
bool LabelPlacer::every_cell(const Rect& rect, Visit&& visit) {
    const auto index = [](double from, int most) {
        return static_cast<int>(std::clamp(std::floor(from / cell), 0.0, static_cast<double>(most - 1)));
    };
    const int left = index(rect.x - panel_.x, columns_), right = index(rect.x + rect.width - panel_.x, columns_);
    const int low = index(rect.y - panel_.y, rows_), high = index(rect.y + rect.height - panel_.y, rows_);
    for (int row = low; row <= high; ++row) {
        for (int column = left; column <= right; ++column) {
            const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
            if (!visit(taken_[at + static_cast<std::size_t>(column)])) return false;
        }
    }
    return true;
}

void LabelPlacer::take(const Rect& rect) {
    every_cell(rect, [](auto flag) {
        flag = true;
        return true;
    });
}

Rect LabelPlacer::inside(const Vec2& centre, const Vec2& size) const {
    const auto hold = [](double from, double low, double room) {
        return std::clamp(from, low, std::max(low, low + room));
    };
    return {hold(centre.x() - 0.5 * size.x(), panel_.x, panel_.width - size.x()),
            hold(centre.y() - 0.5 * size.y(), panel_.y, panel_.height - size.y()), size.x(), size.y()};
}

bool LabelPlacer::is_free(const Rect& rect) {
    return every_cell(rect, [](bool flag) { return !flag; });
}

bool LabelPlacer::is_free(const Vec2& from, const Vec2& to) {
    const auto is_near = [&](const Vec2& at) { return (at - from).norm() < start_of_line; };
    return every_place(from, to, [&](const Vec2& at) { return is_near(at) || is_free({at.x(), at.y(), 0, 0}); });
}

void LabelPlacer::take_line(const Vec2& from, const Vec2& to) {
    every_place(from, to, [&](const Vec2& at) {
        take({at.x(), at.y(), 0, 0});
        return true;
    });
}

std::optional<Rect> LabelPlacer::place(const Vec2& centre, const Vec2& size, const std::optional<Vec2>& anchor) {
    std::optional<Rect> nearest;
    for (double radius = 0; radius <= reach; radius += ring_distance) {
        for (int k = 0; k < (radius > 0 ? tries_a_ring : 1); ++k) {
            const double angle = 0.5 * std::numbers::pi + 2 * std::numbers::pi * k / tries_a_ring;
            const Vec2 aside = radius * size.y() * Vec2(std::cos(angle), std::sin(angle));
            const Rect rect = inside(centre + aside, size);
            if (!is_free(rect)) continue;
            if (!nearest) nearest = rect;
            if (anchor && !is_free(*anchor, nearest_in(rect, *anchor))) continue;
            take(rect);
            return rect;
        }
    }
    if (nearest) take(*nearest);
    return nearest;
}

}  // namespace clsurf::viz

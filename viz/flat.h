#pragma once
// Flat items of a picture: texts, rectangles and lines over its surfaces, placed in pixels of the finished picture, from
// its lower left corner.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
};

enum class Align : std::uint8_t { left, centre, right };
/// The share of a text's width to the left of its position.
[[nodiscard]] constexpr double share_at_left(Align align) {
    return align == Align::left ? 0 : align == Align::right ? 1 : 0.5;
}

struct FlatText {
    double x = 0, y = 0;  ///< baseline side, middle of the line's height
    std::string text;     ///< UTF-8
    double size = 12;     ///< [px]
    Align align = Align::left;
    bool bold = false;
    Rgb rgb{0, 0, 0};
};
struct FlatQuad {
    Rect rect;
    Rgb rgb{0, 0, 0};
};
/// The drawing order of lines; within a level there is no order.
enum class Level : std::uint8_t { area, casing, mark, inlay, edge, line, halo, dot, dot_fill };

struct FlatLine {
    std::vector<Vec2> points;
    double width = 1;
    Rgb rgb{0, 0, 0};
    Level level = Level::line;
    std::optional<Rect> clip{};  ///< clipping rectangle; by default everything is drawn
    /// The second edge of a band, point by point; used instead of `width`.
    std::vector<Vec2> opposite{};
};

/// Its points; for a band, its closed outline.
[[nodiscard]] inline std::vector<Vec2> outline_of(const FlatLine& line) {
    std::vector<Vec2> around = line.points;
    around.insert(around.end(), line.opposite.rbegin(), line.opposite.rend());
    return around;
}

}  // namespace clsurf::viz

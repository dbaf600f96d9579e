#pragma once
// LabelPlacer: finds room for labels on a panel, without overlaps.

#include <optional>
#include <vector>

#include "viz/canvas.h"

namespace clsurf::viz {

/// The point of a rectangle closest to another point.
[[nodiscard]] Vec2 nearest_in(const Rect& rect, const Vec2& to);

class LabelPlacer {
public:
    explicit LabelPlacer(const Rect& panel);

    /// Marks a rectangle [px] as occupied.
    void take(const Rect& rect);
    void take_line(const Vec2& from, const Vec2& to);
    /// Occupies the free rectangle of a size [px] inside the panel whose middle is closest to `centre`. If given, a
    /// line from it to `anchor` crosses nothing that is occupied. Nothing: none within twelve times its height. O(1),
    /// independent of the number of labels.
    [[nodiscard]] std::optional<Rect> place(const Vec2& centre, const Vec2& size,
                                            const std::optional<Vec2>& anchor = std::nullopt);

private:
    template <typename Visit>
    bool every_cell(const Rect& rect, Visit&& visit);
    [[nodiscard]] bool is_free(const Rect& rect);
    [[nodiscard]] bool is_free(const Vec2& from, const Vec2& to);
    [[nodiscard]] Rect inside(const Vec2& centre, const Vec2& size) const;

    Rect panel_;
    int columns_ = 0, rows_ = 0;
    std::vector<bool> taken_;  ///< occupied cells of the panel, row by row
};

}  // namespace clsurf::viz

#pragma once
// LabelPlacer: room for labels on a panel, so that none lies on another one.

#include <optional>
#include <vector>

#include "viz/canvas.h"

namespace clsurf::viz {

/// The place in a rectangle that is nearest to another one.
[[nodiscard]] Vec2 nearest_in(const Rect& rect, const Vec2& to);

class LabelPlacer {
public:
    explicit LabelPlacer(const Rect& panel);

    /// Nothing is placed there any more [px].
    void take(const Rect& rect);
    void take_line(const Vec2& from, const Vec2& to);
    /// Takes the free rectangle of a size [px] whose middle is nearest to `centre`, inside the panel. Where there is one, a
    /// line from it to `anchor` meets nothing that is taken. Nothing: there is none within twelve times its height. O(1),
    /// whatever is taken.
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
    std::vector<bool> taken_;  ///< by cells of the panel, row by row
};

}  // namespace clsurf::viz

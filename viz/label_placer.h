#pragma once
// LabelPlacer: room for labels on a panel, so that none lies on another one.

#include <optional>
#include <vector>

#include "viz/canvas.h"

namespace clsurf::viz {

class LabelPlacer {
public:
    explicit LabelPlacer(const Rect& panel);

    /// Nothing is placed there any more [px].
    void take(const Rect& rect);
    /// Takes the free rectangle of a size [px] whose middle is nearest to `centre`, inside the panel. Nothing: there is
    /// none within twelve times its height. O(1), whatever is taken.
    [[nodiscard]] std::optional<Rect> place(const Vec2& centre, const Vec2& size);

private:
    template <typename Visit>
    bool every_cell(const Rect& rect, Visit&& visit);
    [[nodiscard]] Rect inside(const Vec2& centre, const Vec2& size) const;

    Rect panel_;
    int columns_ = 0, rows_ = 0;
    std::vector<bool> taken_;  ///< by cells of the panel, row by row
};

}  // namespace clsurf::viz

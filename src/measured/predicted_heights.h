#pragma once
// PredictedHeights: heights of the as-machined surface at scattered places, again and again at nearly the same ones. Tiles
// of its height map are computed where they are asked for, and kept.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

class PredictedHeights {
public:
    /// `as_machined` must outlive it.
    explicit PredictedHeights(const AsMachinedSurface& as_machined);

    /// Computes the tiles of places [mm] and of all that lies up to `beside` mm beside them. Parallel. O(new tiles · points
    /// of the path within a tool radius of one).
    void prepare(std::span<const Vec2> places, double beside);

    /// [mm] Linear between cells, a twentieth of a step-over apart: a cusp's tip is up to 5 % of its height too low.
    /// NaN: nothing was cut there, or prepare() was not called for it.
    [[nodiscard]] double at(const Vec2& place) const;
    /// Slopes, of differences over `reach` [mm] to either side.
    [[nodiscard]] Vec2 slopes(const Vec2& place, double reach) const;

    [[nodiscard]] double level() const { return as_machined_.level(); }

private:
    struct Spot {
        std::int64_t column = 0, row = 0;  ///< of the cell
        double x = 0, y = 0;               ///< in it, 0 … 1
    };
    [[nodiscard]] Spot spot_of(const Vec2& place) const;

    const AsMachinedSurface& as_machined_;
    double cell_ = 1;
    Vec2 corner_ = Vec2::Zero();
    std::unordered_map<std::int64_t, std::vector<float>>
        tiles_;  ///< heights over level(), their last row and column again
};

}  // namespace clsurf

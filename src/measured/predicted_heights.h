#pragma once
// PredictedHeights: heights of the as-machined surface at scattered places, for repeated queries at nearby places. Tiles of its
// height map are computed on request and cached.

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

    /// Computes the tiles of places [mm] and of their surroundings within `beside` mm. Parallel. O(new tiles · points of the
    /// path within a tool radius of one).
    void prepare(std::span<const Vec2> places, double beside);

    /// [mm] Linear between cells, which are a twentieth of a step-over apart: the tip of a cusp is up to 5 % of its height too
    /// low. NaN: nothing was cut there, or prepare() was not called for the place.
    [[nodiscard]] double at(const Vec2& place) const;
    /// Slopes from differences over `reach` [mm] to either side.
    [[nodiscard]] Vec2 slopes(const Vec2& place, double reach) const;

    [[nodiscard]] double level() const { return as_machined_.level(); }

private:
    struct Spot {
        std::int64_t column = 0, row = 0;  ///< of the cell
        double x = 0, y = 0;               ///< within the cell, 0 … 1
    };
    [[nodiscard]] Spot spot_of(const Vec2& place) const;

    const AsMachinedSurface& as_machined_;
    double cell_ = 1;
    Vec2 corner_ = Vec2::Zero();
    std::unordered_map<std::int64_t, std::vector<float>>
        tiles_;  ///< heights above level(); they repeat the first row and column of the next tile
};

}  // namespace clsurf

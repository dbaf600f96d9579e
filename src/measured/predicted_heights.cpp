#include "measured/predicted_heights.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "core/not_finite.h"
#include "core/parallel.h"

namespace clsurf {
namespace {

constexpr std::int64_t tile_cells = 64;                     ///< a side
constexpr std::int64_t most_tiles = std::int64_t{1} << 30;  ///< in a row, of either sign; keys then fit into 64 bits

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

std::int64_t key_of(std::int64_t column, std::int64_t row) {
    return (row + most_tiles) * (2 * most_tiles) + (column + most_tiles);
}

}  // namespace

PredictedHeights::PredictedHeights(const AsMachinedSurface& as_machined)
    : as_machined_(as_machined), cell_(as_machined.usual_cell()), corner_(as_machined.bounds().min()) {}

PredictedHeights::Spot PredictedHeights::spot_of(const Vec2& place) const {
    const Vec2 cells = (place - corner_) / cell_;
    const Vec2 whole(std::floor(cells.x()), std::floor(cells.y()));
    return {static_cast<std::int64_t>(whole.x()), static_cast<std::int64_t>(whole.y()), cells.x() - whole.x(),
            cells.y() - whole.y()};
}

void PredictedHeights::prepare(std::span<const Vec2> places, double beside) {
    const Box2& all = as_machined_.bounds();
    std::unordered_set<std::int64_t> seen;
    std::vector<std::pair<std::int64_t, std::int64_t>> wanted;  // column and row of tiles
    for (const Vec2& place : places) {
        if (!place.allFinite() || all.isEmpty() || all.exteriorDistance(place) > beside) continue;
        const Spot low = spot_of(place - Vec2::Constant(beside));
        const Spot high = spot_of(place + Vec2::Constant(beside));
        for (std::int64_t row = floor_div(low.row, tile_cells); row <= floor_div(high.row, tile_cells); ++row) {
            for (std::int64_t c = floor_div(low.column, tile_cells); c <= floor_div(high.column, tile_cells); ++c) {
                const std::int64_t key = key_of(c, row);
                if (tiles_.count(key) == 0 && seen.insert(key).second) wanted.emplace_back(c, row);
            }
        }
    }
    std::vector<std::vector<float>> made(wanted.size());
    parallel_for(static_cast<std::int64_t>(wanted.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            const auto [column, row] = wanted[static_cast<std::size_t>(k)];
            MapFrame frame;
            frame.corner =
                corner_ + cell_ * Vec2(static_cast<double>(column * tile_cells), static_cast<double>(row * tile_cells));
            frame.cell = cell_;
            frame.columns = frame.rows = tile_cells + 1;
            std::vector<float>& tile = made[static_cast<std::size_t>(k)];
            as_machined_.map(frame,
                             [&](std::int64_t, std::span<float> z) { tile.insert(tile.end(), z.begin(), z.end()); });
        }
    });
    for (std::size_t k = 0; k < wanted.size(); ++k)
        tiles_.emplace(key_of(wanted[k].first, wanted[k].second), std::move(made[k]));
}

double PredictedHeights::at(const Vec2& place) const {
    if (!place.allFinite()) return missing<double>;
    const Spot spot = spot_of(place);
    const std::int64_t column = floor_div(spot.column, tile_cells);
    const std::int64_t row = floor_div(spot.row, tile_cells);
    const auto tile = tiles_.find(key_of(column, row));
    if (tile == tiles_.end()) return missing<double>;
    const std::int64_t first = (spot.row - row * tile_cells) * (tile_cells + 1) + spot.column - column * tile_cells;
    const float* z = tile->second.data() + first;
    const double below = z[0] + spot.x * (static_cast<double>(z[1]) - z[0]);
    const double above = z[tile_cells + 1] + spot.x * (static_cast<double>(z[tile_cells + 2]) - z[tile_cells + 1]);
    return as_machined_.level() + below + spot.y * (above - below);
}

Vec2 PredictedHeights::slopes(const Vec2& place, double reach) const {
    const Vec2 x(reach, 0);
    const Vec2 y(0, reach);
    return Vec2(at(place + x) - at(place - x), at(place + y) - at(place - y)) / (2 * reach);
}

}  // namespace clsurf

#include "machined/outline_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/vectorised.h"

namespace clsurf {
namespace {

constexpr std::size_t width = CellGroup::width;
using Lanes = std::array<float, width>;

/// The highest over their planes of cells that a loop has kept apart by their place in a group of `width`.
float highest_of(const Lanes& lanes) { return *std::max_element(lanes.begin(), lanes.end()); }

Lanes lowest_lanes() {
    Lanes lanes;
    lanes.fill(-not_reached);
    return lanes;
}

/// The outline's height is convex in the way, so that the lowest place on the infinite line, held back to the piece's
/// ends, is the lowest on the piece.
CLSURF_VECTORISED float lower_ball(CellGroup& cells, const SweptPiece& piece, float radius) {
    const auto [x, y, tip, dx, dy, half, slope] = piece;
    const auto size = static_cast<std::size_t>(cells.size);
    const float squared = radius * radius;
    const float sine = slope / std::sqrt(1 + slope * slope);
    Lanes highest = lowest_lanes();
    for (std::size_t first = 0; first < size; first += width) {
        for (std::size_t lane = 0; lane < width; ++lane) {
            const std::size_t k = first + lane;
            const float off_x = cells.x[k] - x;
            const float off_y = cells.y[k] - y;
            const float along = off_x * dx + off_y * dy;
            const float across = off_y * dx - off_x * dy;
            const float rest = squared - across * across;
            // The tangent of slope touches the circle of this section `radius · sine` from its middle.
            float at = along - std::sqrt(rest > 0 ? rest : 0.0F) * sine;
            at = at < -half ? -half : at;
            at = at > half ? half : at;
            const float off = along - at;
            const float q = rest - off * off;
            const float height = tip + slope * at + (radius - std::sqrt(q > 0 ? q : 0.0F));
            const float before = cells.z[k];
            const float lowered = height < before ? height : before;
            const float z = q >= 0 ? lowered : before;
            cells.z[k] = z;
            const float over = z - cells.plane[k];
            highest[lane] = over > highest[lane] ? over : highest[lane];
        }
    }
    return highest_of(highest);
}

/// Where the rise along the piece is zero, between the ends by two steps of the secant and a last one.
CLSURF_VECTORISED float lower_bull(CellGroup& cells, const SweptPiece& piece, float radius, float corner) {
    const auto [x, y, tip, dx, dy, half, slope] = piece;
    const auto size = static_cast<std::size_t>(cells.size);
    const float bottom = radius - corner;
    const float squared = corner * corner;
    const float least = 1e-8F * squared;
    Lanes highest = lowest_lanes();
    for (std::size_t first = 0; first < size; first += width) {
        for (std::size_t lane = 0; lane < width; ++lane) {
            const std::size_t k = first + lane;
            const float off_x = cells.x[k] - x, off_y = cells.y[k] - y;
            const float along = off_x * dx + off_y * dy;
            const float aside = (off_y * dx - off_x * dy) * (off_y * dx - off_x * dy);
            const auto rise_at = [&](float at) {
                const float off = along - at;
                const float rho = std::sqrt(off * off + aside) + 1e-9F;
                const float out = rho - bottom > 0 ? rho - bottom : 0.0F;
                const float rest = squared - out * out;
                const float up = std::sqrt(rest > least ? rest : least);
                return slope - out * off / (up * rho);
            };
            float low = -half, high = half;
            float rise_low = rise_at(low), rise_high = rise_at(high);
            // Where it rises from the first end or falls to the last, that is it.
            const bool is_first = rise_low >= 0, is_last = !is_first & (rise_high <= 0);
            high = is_first ? low : high;
            low = is_last ? half : low;
            const auto secant = [&] {
                const float at = low - rise_low * (high - low) / (rise_high - rise_low);
                const float from =
                    at >= low ? at : low;  // also where the rises are equal, and their quotient no number
                return from <= high ? from : high;
            };
            for (int step = 0; step < 2; ++step) {
                const float at = secant();
                const float rise = rise_at(at);
                const bool falls = rise < 0;
                low = falls ? at : low;
                rise_low = falls ? rise : rise_low;
                high = falls ? high : at;
                rise_high = falls ? rise_high : rise;
            }
            const float at = secant();
            const float off = along - at;
            const float rho = std::sqrt(off * off + aside);
            const float out = rho - bottom > 0 ? rho - bottom : 0.0F;
            const float up = squared - out * out;
            const float height = tip + slope * at + (corner - std::sqrt(up > 0 ? up : 0.0F));
            const float before = cells.z[k];
            const float lowered = height < before ? height : before;
            const float z = rho <= radius ? lowered : before;
            cells.z[k] = z;
            const float over = z - cells.plane[k];
            highest[lane] = over > highest[lane] ? over : highest[lane];
        }
    }
    return highest_of(highest);
}

/// Its bottom stands over a cell all the way between two places: the lower one counts.
CLSURF_VECTORISED float lower_flat(CellGroup& cells, const SweptPiece& piece, float radius) {
    const auto [x, y, tip, dx, dy, half, slope] = piece;
    const auto size = static_cast<std::size_t>(cells.size);
    Lanes highest = lowest_lanes();
    for (std::size_t group = 0; group < size; group += width) {
        for (std::size_t lane = 0; lane < width; ++lane) {
            const std::size_t k = group + lane;
            const float off_x = cells.x[k] - x;
            const float off_y = cells.y[k] - y;
            const float along = off_x * dx + off_y * dy;
            const float across = off_y * dx - off_x * dy;
            const float rest = radius * radius - across * across;
            const float reach = std::sqrt(rest > 0 ? rest : 0.0F);
            const float first = along - reach > -half ? along - reach : -half;
            const float last = along + reach < half ? along + reach : half;
            const float height = tip + slope * (slope >= 0 ? first : last);
            const float before = cells.z[k];
            const float lowered = height < before ? height : before;
            const float z = (rest >= 0) & (first <= last) ? lowered : before;
            cells.z[k] = z;
            const float over = z - cells.plane[k];
            highest[lane] = over > highest[lane] ? over : highest[lane];
        }
    }
    return highest_of(highest);
}

}  // namespace

float Outline::height(float rho) const {
    if (rho > radius_) return not_reached;
    const float out = std::max(rho - bottom_, 0.0F);
    return corner_ - std::sqrt(std::max(corner_ * corner_ - out * out, 0.0F));
}

float Outline::lower(CellGroup& cells, const SweptPiece& piece) const {
    switch (kind_) {
        case ToolKind::ball: return lower_ball(cells, piece, radius_);
        case ToolKind::bull: return lower_bull(cells, piece, radius_, corner_);
        case ToolKind::flat: return lower_flat(cells, piece, radius_);
    }
    return not_reached;
}

}  // namespace clsurf

#include "machined/outline_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/vectorised.h"

namespace clsurf {
namespace {

constexpr std::size_t width = CellGroup::width;
using Lanes = std::array<float, width>;

/// Lowers each cell to height(along, across), with its position relative to the middle of the piece; infinite: not reached.
/// Returns the largest height above its plane. Inlined into vectorised code.
template <typename Height>
[[gnu::always_inline]] inline float lower_each(CellGroup& cells, const SweptPiece& piece, const Height& height) {
    const auto size = static_cast<std::size_t>(cells.size);
    Lanes highest;
    highest.fill(-not_reached);
    for (std::size_t first = 0; first < size; first += width) {
        for (std::size_t lane = 0; lane < width; ++lane) {
            const std::size_t k = first + lane;
            const float off_x = cells.x[k] - piece.x;
            const float off_y = cells.y[k] - piece.y;
            const float there = height(off_x * piece.dx + off_y * piece.dy, off_y * piece.dx - off_x * piece.dy);
            const float before = cells.z[k];
            const float z = there < before ? there : before;
            cells.z[k] = z;
            const float over = z - cells.plane[k];
            highest[lane] = over > highest[lane] ? over : highest[lane];
        }
    }
    return *std::max_element(highest.begin(), highest.end());
}

/// The outline's height is convex along the motion. Therefore the lowest place on the infinite line, clamped to the piece's
/// ends, is the lowest on the piece.
CLSURF_VECTORISED float lower_ball(CellGroup& cells, const SweptPiece& piece, float radius) {
    const float tip = piece.z, half = piece.half, slope = piece.slope;
    const float squared = radius * radius;
    const float sine = slope / std::sqrt(1 + slope * slope);
    return lower_each(
        cells, piece, [=](float along, float across) __attribute__((always_inline)) {
            const float rest = squared - across * across;
            // The tangent with this slope touches the circle of this section at `radius · sine` from its middle.
            float at = along - std::sqrt(rest > 0 ? rest : 0.0F) * sine;
            at = at < -half ? -half : at;
            at = at > half ? half : at;
            const float off = along - at;
            const float q = rest - off * off;
            const float height = tip + slope * at + (radius - std::sqrt(q > 0 ? q : 0.0F));
            return q >= 0 ? height : not_reached;
        });
}

/// Finds where the rise along the piece is zero, between its ends, by two secant steps and a last one.
CLSURF_VECTORISED float lower_bull(CellGroup& cells, const SweptPiece& piece, float radius, float corner) {
    const float tip = piece.z, half = piece.half, slope = piece.slope;
    const float bottom = radius - corner;
    const float squared = corner * corner;
    const float least = 1e-8F * squared;
    return lower_each(
        cells, piece, [=](float along, float across) __attribute__((always_inline)) {
            const float aside = across * across;
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
            // If it rises from the first end or falls to the last, that end is the lowest place.
            const bool is_first = rise_low >= 0, is_last = !is_first & (rise_high <= 0);
            high = is_first ? low : high;
            low = is_last ? half : low;
            const auto secant = [&] {
                const float at = low - rise_low * (high - low) / (rise_high - rise_low);
                const float from = at >= low ? at : low;  // also if the rises are equal, so that their quotient is NaN
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
            return rho <= radius ? height : not_reached;
        });
}

/// The flat bottom is over a cell all the way between two places; the lower one counts.
CLSURF_VECTORISED float lower_flat(CellGroup& cells, const SweptPiece& piece, float radius) {
    const float tip = piece.z, half = piece.half, slope = piece.slope;
    return lower_each(
        cells, piece, [=](float along, float across) __attribute__((always_inline)) {
            const float rest = radius * radius - across * across;
            const float reach = std::sqrt(rest > 0 ? rest : 0.0F);
            const float first = along - reach > -half ? along - reach : -half;
            const float last = along + reach < half ? along + reach : half;
            const float height = tip + slope * (slope >= 0 ? first : last);
            return (rest >= 0) & (first <= last) ? height : not_reached;
        });
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

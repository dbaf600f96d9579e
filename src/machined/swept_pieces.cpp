#include "machined/swept_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>

#include "core/vectorised.h"

namespace clsurf {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();
constexpr int leaf_side = 8;
constexpr int leaf_cells = leaf_side * leaf_side;  ///< of a block that is not divided any further
constexpr float gentle = 0.04F;     ///< of the corner radius squared: a steeper outline has no useful tangent plane
constexpr float rounding = 2e-6F;   ///< [mm] of heights
constexpr double corner_share = 4;  ///< pieces of a bull-nose tool to its corner radius
constexpr double standing = 1e-6;   ///< [mm] in the plane

/// The tool as the loops use it [mm].
struct Outline {
    float radius, corner, bottom;  ///< bottom: radius of what is flat

    explicit Outline(const CuttingTool& tool)
        : radius(static_cast<float>(tool.radius)),
          corner(static_cast<float>(tool.corner)),
          bottom(static_cast<float>(tool.radius - tool.corner)) {}

    [[nodiscard]] float height(float rho) const {
        if (rho > radius) return nothing;
        const float out = std::max(rho - bottom, 0.0F);
        return corner - std::sqrt(std::max(corner * corner - out * out, 0.0F));
    }
};

struct Block {
    int column, row, columns, rows;
};

/// The middle of a block and half of its sides [mm].
struct Extent {
    float x, y, half_x, half_y;

    Extent(const Block& block, const CellBlock& cells)
        : x((static_cast<float>(block.column) + 0.5F * static_cast<float>(block.columns - 1)) * cells.cell),
          y((static_cast<float>(block.row) + 0.5F * static_cast<float>(block.rows - 1)) * cells.row_pitch),
          half_x(0.5F * static_cast<float>(block.columns - 1) * cells.cell),
          half_y(0.5F * static_cast<float>(block.rows - 1) * cells.row_pitch) {}
    [[nodiscard]] float diagonal() const { return std::sqrt(half_x * half_x + half_y * half_y); }
};

/// What each piece is over the middle of a block: height of the tool in the middle of the piece, its slopes; and
/// how low it can be anywhere in the block over a plane through nothing in the middle.
struct Reach {
    std::vector<float> height, slope_x, slope_y, bound;

    void resize(std::size_t count) {
        for (std::vector<float>* column : {&height, &slope_x, &slope_y, &bound}) column->resize(count);
    }
};

/// Height and slopes over a place in the middle of the block; infinite where the outline there is too steep.
CLSURF_VECTORISED void measure_heights(const SweptPieces& p, const Outline& tool, const Extent& e, Reach& reach) {
    const std::size_t count = p.size();
    const float* const x = p.x.data();
    const float* const y = p.y.data();
    const float* const z = p.z.data();
    const float* const dx = p.dx.data();
    const float* const dy = p.dy.data();
    const float* const length = p.length.data();
    const float* const slope = p.slope.data();
    float* const height = reach.height.data();
    float* const slope_x = reach.slope_x.data();
    float* const slope_y = reach.slope_y.data();
    const float radius = tool.radius, corner = tool.corner, bottom = tool.bottom, at_x = e.x, at_y = e.y;
    const float squared = corner * corner;
    for (std::size_t k = 0; k < count; ++k) {
        const float half = 0.5F * length[k];
        const float off_x = at_x - x[k] - dx[k] * half;
        const float off_y = at_y - y[k] - dy[k] * half;
        const float rho = std::sqrt(off_x * off_x + off_y * off_y);
        const float beyond = rho - bottom;
        const float out = beyond > 0 ? beyond : 0.0F;
        const float rest = squared - out * out;
        const float up = std::sqrt(rest > 0 ? rest : 0.0F);
        const float steep = out / ((up > 1e-9F ? up : 1e-9F) * (rho > 1e-9F ? rho : 1e-9F));
        const bool flat = rho < bottom;
        const bool usable = flat | ((rest > gentle * squared) & (rho < radius));
        slope_x[k] = flat ? 0.0F : steep * off_x;
        slope_y[k] = flat ? 0.0F : steep * off_y;
        height[k] = usable ? z[k] + slope[k] * half + corner - up : nothing;
    }
}

/// How low each piece can be over the block, less a plane of slopes `plane_x`, `plane_y`.
CLSURF_VECTORISED void measure_bounds(const SweptPieces& p, const Outline& tool, const Extent& e, float plane_x,
                                      float plane_y, Reach& reach) {
    const std::size_t count = p.size();
    const float* const x = p.x.data();
    const float* const y = p.y.data();
    const float* const z = p.z.data();
    const float* const dx = p.dx.data();
    const float* const dy = p.dy.data();
    const float* const length = p.length.data();
    const float* const slope = p.slope.data();
    const float* const height = reach.height.data();
    const float* const slope_x = reach.slope_x.data();
    const float* const slope_y = reach.slope_y.data();
    float* const bound = reach.bound.data();
    const float radius = tool.radius, corner = tool.corner, bottom = tool.bottom;
    const float at_x = e.x, at_y = e.y, half_x = e.half_x, half_y = e.half_y, diagonal = e.diagonal();
    const float plane_falls = std::abs(plane_x) * half_x + std::abs(plane_y) * half_y;
    for (std::size_t k = 0; k < count; ++k) {
        const float half = 0.5F * length[k];
        const float tangent = height[k] - std::abs(slope_x[k] - plane_x) * half_x -
                              std::abs(slope_y[k] - plane_y) * half_y -
                              std::abs(slope[k] - slope_x[k] * dx[k] - slope_y[k] * dy[k]) * half;
        // Where it is steep, by how near the axis comes to the block.
        const float off_x = at_x - x[k] - dx[k] * half;
        const float off_y = at_y - y[k] - dy[k] * half;
        const float apart = std::sqrt(off_x * off_x + off_y * off_y) - diagonal - half;
        const float nearest = apart > 0 ? apart : 0.0F;
        const float beyond = nearest - bottom;
        const float out = beyond > 0 ? beyond : 0.0F;
        const float rest = corner * corner - out * out;
        const float radial = z[k] + slope[k] * half - std::abs(slope[k]) * half + corner -
                             std::sqrt(rest > 0 ? rest : 0.0F) - plane_falls;
        const float either = height[k] < nothing ? tangent : radial;
        bound[k] = nearest <= radius ? either : nothing;
    }
}

/// A block of cells seen from a piece: along = s + column · s_column + row · s_row, and across.
struct Seen {
    float s, s_column, s_row, w, w_column, w_row;
};

Seen seen_from(const SweptPieces& p, std::size_t k, const Block& block, const CellBlock& cells) {
    const float off_x = static_cast<float>(block.column) * cells.cell - p.x[k];
    const float off_y = static_cast<float>(block.row) * cells.row_pitch - p.y[k];
    const float dx = p.dx[k];
    const float dy = p.dy[k];
    return {off_x * dx + off_y * dy, dx * cells.cell,  dy * cells.row_pitch,
            off_y * dx - off_x * dy, -dy * cells.cell, dx * cells.row_pitch};
}

/// The cells of a leaf, `stride` from row to row.
struct Leaf {
    float* z;
    int columns, rows, stride;
};

/// One piece under a ball. The outline's height is convex in the way, so that the lowest place on the infinite line,
/// held back to the piece's ends, is the lowest on the piece.
CLSURF_VECTORISED void lower_ball(const Leaf& leaf, const Seen& seen, float radius, float slope, float length,
                                  float tip) {
    const float squared = radius * radius;
    const float sine = slope / std::sqrt(1 + slope * slope);
    for (int row = 0; row < leaf.rows; ++row) {
        float* const z = leaf.z + static_cast<std::ptrdiff_t>(row) * leaf.stride;
        const float s = seen.s + static_cast<float>(row) * seen.s_row;
        const float w = seen.w + static_cast<float>(row) * seen.w_row;
        for (int k = 0; k < leaf.columns; ++k) {
            const auto x = static_cast<float>(k);
            const float along = s + seen.s_column * x;
            const float across = w + seen.w_column * x;
            const float rest = squared - across * across;
            // The tangent of slope touches the circle of this section `half · sine` from its middle.
            float at = along - std::sqrt(rest > 0 ? rest : 0.0F) * sine;
            at = at < 0 ? 0.0F : at;
            at = at > length ? length : at;
            const float off = along - at;
            const float q = rest - off * off;
            const float height = tip + slope * at + (radius - std::sqrt(q > 0 ? q : 0.0F));
            const float lowered = height < z[k] ? height : z[k];
            z[k] = q >= 0 ? lowered : z[k];
        }
    }
}

/// One piece under a bull-nose tool: where the rise along it is zero, between the ends by two steps of the secant.
CLSURF_VECTORISED void lower_bull(const Leaf& leaf, const Seen& seen, float radius, float corner, float slope,
                                  float length, float tip) {
    const float bottom = radius - corner;
    const float squared = corner * corner;
    const float least_up = 1e-4F * corner;
    for (int row = 0; row < leaf.rows; ++row) {
        float* const z = leaf.z + static_cast<std::ptrdiff_t>(row) * leaf.stride;
        const float s = seen.s + static_cast<float>(row) * seen.s_row;
        const float w = seen.w + static_cast<float>(row) * seen.w_row;
        for (int k = 0; k < leaf.columns; ++k) {
            const auto x = static_cast<float>(k);
            const float along = s + seen.s_column * x;
            const float across = w + seen.w_column * x;
            float low = 0, high = length;
            float rise_low = 0, rise_high = 0;
            float at = 0;
            for (int step = 0; step < 4; ++step) {
                at = step == 0 ? 0.0F : step == 1 ? length : low - rise_low * (high - low) / (rise_high - rise_low);
                at = at >= low ? at : low;  // also where the rises are equal, and their quotient no number
                at = at <= high ? at : high;
                const float off = along - at;
                const float rho = std::sqrt(off * off + across * across) + 1e-9F;
                const float out = rho - bottom > 0 ? rho - bottom : 0.0F;
                const float rest = squared - out * out;
                const float up = std::sqrt(rest > least_up * least_up ? rest : least_up * least_up);
                const float rise = slope - out * off / (up * rho);
                const bool falls = rise < 0;
                // The first two steps are the ends: where it rises from the first or falls to the last, that is it.
                if (step == 0) rise_low = rise;
                if (step == 1) rise_high = rise;
                low = (step > 1) & falls ? at : low;
                rise_low = (step > 1) & falls ? rise : rise_low;
                high = (step > 1) & !falls ? at : high;
                rise_high = (step > 1) & !falls ? rise : rise_high;
                if (step == 1) {
                    high = rise_low >= 0 ? 0.0F : high;
                    low = (rise_low < 0) & (rise_high <= 0) ? length : low;
                }
            }
            const float fraction = low - rise_low * (high - low) / (rise_high - rise_low);
            at = fraction >= low ? fraction : low;
            at = at <= high ? at : high;
            const float off = along - at;
            const float rho = std::sqrt(off * off + across * across);
            const float out = rho - bottom > 0 ? rho - bottom : 0.0F;
            const float up = squared - out * out;
            const float height = tip + slope * at + (corner - std::sqrt(up > 0 ? up : 0.0F));
            const float lowered = height < z[k] ? height : z[k];
            z[k] = rho <= radius ? lowered : z[k];
        }
    }
}

/// One piece under a flat tool: its bottom stands over a cell all the way between two places: the lower one counts.
CLSURF_VECTORISED void lower_flat(const Leaf& leaf, const Seen& seen, float radius, float slope, float length,
                                  float tip) {
    for (int row = 0; row < leaf.rows; ++row) {
        float* const z = leaf.z + static_cast<std::ptrdiff_t>(row) * leaf.stride;
        const float s = seen.s + static_cast<float>(row) * seen.s_row;
        const float w = seen.w + static_cast<float>(row) * seen.w_row;
        for (int k = 0; k < leaf.columns; ++k) {
            const auto x = static_cast<float>(k);
            const float along = s + seen.s_column * x;
            const float across = w + seen.w_column * x;
            const float rest = radius * radius - across * across;
            const float half = std::sqrt(rest > 0 ? rest : 0.0F);
            const float first = along - half > 0 ? along - half : 0.0F;
            const float last = along + half < length ? along + half : length;
            const float height = tip + slope * (slope >= 0 ? first : last);
            const float lowered = height < z[k] ? height : z[k];
            z[k] = (rest >= 0) & (first <= last) ? lowered : z[k];
        }
    }
}

/// The highest cell over a plane of these slopes through the middle of the block.
CLSURF_VECTORISED float highest_over(const Leaf& leaf, float step_x, float step_y) {
    float most = -nothing;
    for (int row = 0; row < leaf.rows; ++row) {
        const float* const z = leaf.z + static_cast<std::ptrdiff_t>(row) * leaf.stride;
        const float plane = step_y * (static_cast<float>(row) - 0.5F * static_cast<float>(leaf.rows - 1)) -
                            step_x * 0.5F * static_cast<float>(leaf.columns - 1);
        for (int k = 0; k < leaf.columns; ++k) {
            const float over = z[k] - plane - step_x * static_cast<float>(k);
            most = over > most ? over : most;
        }
    }
    return most;
}

class Sweep {
public:
    Sweep(const CuttingTool& tool, const CellBlock& cells) : kind_(tool.kind), tool_(tool), cells_(cells) {}

    void run(const SweptPieces& pieces) { lower(pieces, {0, 0, cells_.columns, cells_.rows}, 0); }

private:
    /// What a depth of the division works with.
    struct Level {
        Reach reach;
        SweptPieces kept;
    };

    void lower(const SweptPieces& pieces, const Block& block, std::size_t depth) {
        if (pieces.size() == 0 || block.columns <= 0 || block.rows <= 0) return;
        if (depth == levels_.size()) levels_.emplace_back();
        Level& level = levels_[depth];
        const Extent extent(block, cells_);
        Reach& reach = level.reach;
        reach.resize(pieces.size());
        measure_heights(pieces, tool_, extent, reach);
        const auto lowest =
            static_cast<std::size_t>(std::min_element(reach.height.begin(), reach.height.end()) - reach.height.begin());
        const bool known = reach.height[lowest] < nothing;
        const float plane_x = known ? reach.slope_x[lowest] : 0.0F;
        const float plane_y = known ? reach.slope_y[lowest] : 0.0F;
        measure_bounds(pieces, tool_, extent, plane_x, plane_y, reach);
        if (block.columns * block.rows <= leaf_cells) return lower_leaf(pieces, block, reach, plane_x, plane_y);
        const float top = known ? highest_at_corners(pieces, lowest, extent, plane_x, plane_y) : nothing;
        level.kept.clear();
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            if (reach.bound[k] < nothing && reach.bound[k] <= top + rounding) level.kept.copy(pieces, k);
        }
        // The longer side, or both: blocks stay about square.
        const Block& b = block;
        const int left = b.columns > 1 && 2 * b.columns > b.rows ? (b.columns + 1) / 2 : b.columns;
        const int low = b.rows > 1 && 2 * b.rows > b.columns ? (b.rows + 1) / 2 : b.rows;
        for (const Block& part :
             {Block{b.column, b.row, left, low}, Block{b.column + left, b.row, b.columns - left, low},
              Block{b.column, b.row + low, left, b.rows - low},
              Block{b.column + left, b.row + low, b.columns - left, b.rows - low}})
            lower(level.kept, part, depth + 1);
    }

    /// How high the tool in the middle of a piece stands over the plane at the block's corners: since its outline is
    /// convex, nowhere in the block does it stand higher.
    [[nodiscard]] float highest_at_corners(const SweptPieces& p, std::size_t k, const Extent& e, float plane_x,
                                           float plane_y) const {
        float most = -nothing;
        const float half = 0.5F * p.length[k];
        for (const float x : {-e.half_x, e.half_x}) {
            for (const float y : {-e.half_y, e.half_y}) {
                const float rho = std::hypot(e.x + x - p.x[k] - p.dx[k] * half, e.y + y - p.y[k] - p.dy[k] * half);
                most = std::max(most, p.z[k] + p.slope[k] * half + tool_.height(rho) - plane_x * x - plane_y * y);
            }
        }
        return most;
    }

    void lower_leaf(const SweptPieces& pieces, const Block& block, const Reach& reach, float plane_x, float plane_y) {
        order_.clear();
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            if (reach.bound[k] < nothing) order_.push_back(static_cast<std::uint32_t>(k));
        }
        // The lowest in the middle first: after a few of them, most of the others are too high.
        const auto sooner = [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(reach.height[a], reach.bound[a]) < std::pair(reach.height[b], reach.bound[b]);
        };
        const Leaf leaf{cells_.z + static_cast<std::ptrdiff_t>(block.row) * cells_.columns + block.column,
                        block.columns, block.rows, cells_.columns};
        constexpr std::size_t at_a_time = 16;
        float top = highest_over(leaf, plane_x * cells_.cell, plane_y * cells_.row_pitch);
        for (std::size_t first = 0; first < order_.size(); first += at_a_time) {
            const std::size_t end = std::min(order_.size(), first + at_a_time);
            const auto from = order_.begin() + static_cast<std::ptrdiff_t>(first);
            std::partial_sort(from, order_.begin() + static_cast<std::ptrdiff_t>(end), order_.end(), sooner);
            for (std::size_t k = first; k < end; ++k) {
                if (reach.bound[order_[k]] > top + rounding) continue;
                lower_by(pieces, order_[k], block, leaf);
                top = highest_over(leaf, plane_x * cells_.cell, plane_y * cells_.row_pitch);
            }
            std::erase_if(order_, [&, n = std::size_t{0}](std::uint32_t k) mutable {
                return n++ >= end && reach.bound[k] > top + rounding;
            });
        }
    }

    void lower_by(const SweptPieces& p, std::size_t k, const Block& block, const Leaf& leaf) const {
        const Seen seen = seen_from(p, k, block, cells_);
        switch (kind_) {
            case ToolKind::ball: return lower_ball(leaf, seen, tool_.radius, p.slope[k], p.length[k], p.z[k]);
            case ToolKind::bull:
                return lower_bull(leaf, seen, tool_.radius, tool_.corner, p.slope[k], p.length[k], p.z[k]);
            case ToolKind::flat: return lower_flat(leaf, seen, tool_.radius, p.slope[k], p.length[k], p.z[k]);
        }
    }

    ToolKind kind_;
    Outline tool_;
    CellBlock cells_;
    std::deque<Level> levels_;  // whose addresses stay
    std::vector<std::uint32_t> order_;
};

}  // namespace

void SweptPieces::clear() {
    for (std::vector<float>* column : {&x, &y, &z, &dx, &dy, &length, &slope}) column->clear();
}

void SweptPieces::add(const Vec3& from, const Vec3& to, double longest) {
    const Vec3 step = to - from;
    const double whole = step.head<2>().norm();
    if (!step.allFinite() || !from.allFinite()) return;
    const bool stands = whole < standing;
    const Vec2 direction = stands ? Vec2(Vec2::UnitX()) : Vec2(step.head<2>() / whole);
    const int count = stands ? 1 : static_cast<int>(std::ceil(whole / longest));
    for (int k = 0; k < count; ++k) {
        const Vec3 here = from + step * (static_cast<double>(k) / count);
        x.push_back(static_cast<float>(here.x()));
        y.push_back(static_cast<float>(here.y()));
        z.push_back(static_cast<float>(stands ? std::min(from.z(), to.z()) : here.z()));
        dx.push_back(static_cast<float>(direction.x()));
        dy.push_back(static_cast<float>(direction.y()));
        length.push_back(stands ? 0.0F : static_cast<float>(whole / count));
        slope.push_back(stands ? 0.0F : static_cast<float>(step.z() / whole));
    }
}

void SweptPieces::copy(const SweptPieces& other, std::size_t k) {
    x.push_back(other.x[k]);
    y.push_back(other.y[k]);
    z.push_back(other.z[k]);
    dx.push_back(other.dx[k]);
    dy.push_back(other.dy[k]);
    length.push_back(other.length[k]);
    slope.push_back(other.slope[k]);
}

double longest_piece(const CuttingTool& tool, double cell) {
    const double longest = std::max(leaf_side * cell, tool.radius / 32);
    return tool.kind == ToolKind::bull ? std::min(longest, std::max(tool.corner / corner_share, cell)) : longest;
}

void lower(const CuttingTool& tool, const SweptPieces& pieces, const CellBlock& cells) {
    Sweep(tool, cells).run(pieces);
}

}  // namespace clsurf

#include "machined/swept_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "core/vectorised.h"
#include "machined/outline_sweep.h"

namespace clsurf {
namespace {

// side, few, kept_share: time alone depends on how blocks are divided, heights do not (rounding excepted).
constexpr int side = 4;              ///< cells of a block that is not divided further
constexpr std::size_t few = 8;       ///< number of pieces that is not worth a division
constexpr double kept_share = 0.9;   ///< share of pieces: a division that keeps more is useless
constexpr float gentle = 0.04F;      ///< of the corner radius squared: a steeper outline has no useful tangent plane
constexpr float rounding = 2e-6F;    ///< [mm] of heights; 2^-24 of 32 mm
constexpr double corner_share = 4;   ///< number of pieces per corner radius of a bull-nose tool
constexpr double longest_cells = 8;  ///< cells per piece, or more if the tool is large compared with the cells
constexpr double standing = 1e-6;    ///< [mm] in the plane: a shorter motion is vertical

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

/// The slopes of a plane through the origin in the middle of a block.
struct Plane {
    float slope_x = 0, slope_y = 0;
};

/// Pieces as one column per member.
class PieceColumns {
public:
    explicit PieceColumns(const std::vector<SweptPiece>& pieces = {}) {
        for (std::vector<float>* column : columns()) column->reserve(pieces.size());
        for (const SweptPiece& p : pieces) {
            x.push_back(p.x);
            y.push_back(p.y);
            z.push_back(p.z);
            dx.push_back(p.dx);
            dy.push_back(p.dy);
            half.push_back(p.half);
            slope.push_back(p.slope);
        }
    }

    [[nodiscard]] std::size_t size() const { return x.size(); }
    [[nodiscard]] SweptPiece operator[](std::size_t k) const {
        return {x[k], y[k], z[k], dx[k], dy[k], half[k], slope[k]};
    }
    /// Replaces the pieces by those of `others` with these numbers.
    void take(const PieceColumns& others, const std::vector<std::uint32_t>& numbers) {
        const auto to = columns();
        const auto from = others.columns();
        for (std::size_t column = 0; column < to.size(); ++column) {
            to[column]->resize(numbers.size());
            float* const out = to[column]->data();
            const float* const in = from[column]->data();
            for (std::size_t k = 0; k < numbers.size(); ++k) out[k] = in[numbers[k]];
        }
    }

    std::vector<float> x, y, z, dx, dy, half, slope;

private:
    [[nodiscard]] std::array<std::vector<float>*, 7> columns() { return {&x, &y, &z, &dx, &dy, &half, &slope}; }
    [[nodiscard]] std::array<const std::vector<float>*, 7> columns() const {
        return {&x, &y, &z, &dx, &dy, &half, &slope};
    }
};

/// Each piece over the middle of a block. `height`, `slope_x`, `slope_y`: of the tool in the middle of the piece, infinite and
/// 0 if the outline is too steep there. `low`: how low the tool can be there along the whole piece, or, if it is too steep,
/// anywhere in the block; infinite: it reaches no cell.
struct Reach {
    std::vector<float> height, slope_x, slope_y, low;

    void resize(std::size_t count) {
        for (std::vector<float>* column : {&height, &slope_x, &slope_y, &low}) column->resize(count);
    }
};

CLSURF_VECTORISED void measure(const PieceColumns& p, const Outline& tool, const Extent& e, Reach& reach) {
    const std::size_t count = p.size();
    const float* const x = p.x.data();
    const float* const y = p.y.data();
    const float* const z = p.z.data();
    const float* const dx = p.dx.data();
    const float* const dy = p.dy.data();
    const float* const half = p.half.data();
    const float* const slope = p.slope.data();
    float* const height = reach.height.data();
    float* const slope_x = reach.slope_x.data();
    float* const slope_y = reach.slope_y.data();
    float* const low = reach.low.data();
    const float radius = tool.radius(), corner = tool.corner(), bottom = tool.bottom(), at_x = e.x, at_y = e.y;
    const float squared = corner * corner, diagonal = e.diagonal();
    // The columns do not overlap, and there are too many for the compiler to check at run time.
#pragma GCC ivdep
    for (std::size_t k = 0; k < count; ++k) {
        const float off_x = at_x - x[k];
        const float off_y = at_y - y[k];
        const float rho = std::sqrt(off_x * off_x + off_y * off_y);
        const float beyond = rho - bottom;
        const float out = beyond > 0 ? beyond : 0.0F;
        const float rest = squared - out * out;
        const float up = std::sqrt(rest > 0 ? rest : 0.0F);
        const float steep = out / ((up > 1e-9F ? up : 1e-9F) * (rho > 1e-9F ? rho : 1e-9F));
        const bool flat = rho < bottom;
        const bool usable = flat | ((rest > gentle * squared) & (rho < radius));
        const float rise_x = usable & !flat ? steep * off_x : 0.0F;
        const float rise_y = usable & !flat ? steep * off_y : 0.0F;
        const float over = z[k] + corner - up;
        slope_x[k] = rise_x;
        slope_y[k] = rise_y;
        height[k] = usable ? over : not_reached;
        const float tangent = over - std::abs(slope[k] - rise_x * dx[k] - rise_y * dy[k]) * half[k];
        // If the outline is steep: by the least distance of the axis from the block.
        const float apart = rho - diagonal - half[k];
        const float nearest = apart > 0 ? apart : 0.0F;
        const float past = nearest - bottom > 0 ? nearest - bottom : 0.0F;
        const float left = squared - past * past;
        const float radial = z[k] - std::abs(slope[k]) * half[k] + corner - std::sqrt(left > 0 ? left : 0.0F);
        const float either = usable ? tangent : radial;
        low[k] = nearest <= radius ? either : not_reached;
    }
}

/// Changes `low` from the middle of a block to the whole block, relative to a plane.
CLSURF_VECTORISED void lean(Reach& reach, const Extent& e, const Plane& plane) {
    const std::size_t count = reach.low.size();
    const float* const slope_x = reach.slope_x.data();
    const float* const slope_y = reach.slope_y.data();
    float* const low = reach.low.data();
    const float plane_x = plane.slope_x, plane_y = plane.slope_y, half_x = e.half_x, half_y = e.half_y;
    for (std::size_t k = 0; k < count; ++k)
        low[k] -= std::abs(slope_x[k] - plane_x) * half_x + std::abs(slope_y[k] - plane_y) * half_y;
}

/// The numbers of pieces that can be as low as `top`.
void find_low(const std::vector<float>& low, float top, std::vector<std::uint32_t>& found) {
    found.resize(low.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < low.size(); ++k) {
        found[count] = static_cast<std::uint32_t>(k);
        count += static_cast<std::size_t>((low[k] < not_reached) & (low[k] <= top));
    }
    found.resize(count);
}

/// The index of the least value; the first one of several.
CLSURF_VECTORISED std::size_t least_of(const std::vector<float>& values) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> least;
    least.fill(not_reached);
    const float* const from = values.data();
    std::size_t k = 0;
    for (; k + lanes <= values.size(); k += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            least[lane] = from[k + lane] < least[lane] ? from[k + lane] : least[lane];
    }
    float lowest = *std::min_element(least.begin(), least.end());
    for (; k < values.size(); ++k) lowest = std::min(lowest, from[k]);
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), lowest) - values.begin());
}

class Sweep {
public:
    Sweep(const CuttingTool& tool, const CellBlock& cells) : tool_(tool), cells_(cells) {}

    void run(const PieceColumns& pieces) { lower(pieces, {0, 0, cells_.columns, cells_.rows}, 0); }

private:
    /// Work space of one depth of the division.
    struct Level {
        Reach reach;
        std::vector<std::uint32_t> found;
        PieceColumns kept;
    };

    void lower(const PieceColumns& pieces, const Block& block, std::size_t depth) {
        if (pieces.size() == 0 || block.columns <= 0 || block.rows <= 0) return;
        if (depth == levels_.size()) levels_.emplace_back();
        Level& level = levels_[depth];
        const Extent extent(block, cells_);
        Reach& reach = level.reach;
        reach.resize(pieces.size());
        measure(pieces, tool_, extent, reach);
        const std::size_t lowest = least_of(reach.height);
        const bool known = reach.height[lowest] < not_reached;
        const Plane plane = known ? Plane{reach.slope_x[lowest], reach.slope_y[lowest]} : Plane{};
        const float top = known ? highest_at_corners(pieces[lowest], extent, plane) : not_reached;
        lean(reach, extent, plane);
        find_low(reach.low, top + rounding, level.found);
        const int cells = block.columns * block.rows;
        // A division is also useless if each part keeps nearly all pieces: a flat bottom covers all parts alike.
        const bool is_divided = level.found.size() > few && static_cast<double>(level.found.size()) <=
                                                                kept_share * static_cast<double>(pieces.size());
        if (cells <= side * side || (cells <= CellGroup::most && !is_divided)) {
            gather(block, extent, plane);
            lower_group(pieces, level, lowest);
            return scatter(block);
        }
        level.kept.take(pieces, level.found);
        // Divides the longer side, or both, so that blocks stay about square.
        const Block& b = block;
        const int left = b.columns > 1 && 2 * b.columns > b.rows ? half_of(b.columns) : b.columns;
        const int low = b.rows > 1 && 2 * b.rows > b.columns ? half_of(b.rows) : b.rows;
        for (const Block& part :
             {Block{b.column, b.row, left, low}, Block{b.column + left, b.row, b.columns - left, low},
              Block{b.column, b.row + low, left, b.rows - low},
              Block{b.column + left, b.row + low, b.columns - left, b.rows - low}})
            lower(level.kept, part, depth + 1);
    }

    /// A multiple of whole blocks if there are at least two.
    static int half_of(int cells) { return cells > side ? (cells / side + 1) / 2 * side : (cells + 1) / 2; }

    /// The largest height of the tool in the middle of a piece above the plane at the corners of the block. The outline is
    /// convex, so it is nowhere higher in the block.
    [[nodiscard]] float highest_at_corners(const SweptPiece& p, const Extent& e, const Plane& plane) const {
        float most = -not_reached;
        for (const float x : {-e.half_x, e.half_x}) {
            for (const float y : {-e.half_y, e.half_y}) {
                const float off_x = e.x + x - p.x, off_y = e.y + y - p.y;
                const float rho = std::sqrt(off_x * off_x + off_y * off_y);
                most = std::max(most, p.z + tool_.height(rho) - plane.slope_x * x - plane.slope_y * y);
            }
        }
        return most;
    }

    void gather(const Block& block, const Extent& extent, const Plane& plane) {
        group_.size = 0;
        for (int row = 0; row < block.rows; ++row) {
            const float y = static_cast<float>(block.row + row) * cells_.row_pitch;
            const float* const z = first_of(block, row);
            for (int column = 0; column < block.columns; ++column) {
                const float x = static_cast<float>(block.column + column) * cells_.cell;
                group_.add(x, y, plane.slope_x * (x - extent.x) + plane.slope_y * (y - extent.y), z[column]);
            }
        }
        group_.fill_up();
    }

    void scatter(const Block& block) {
        const float* from = group_.z.data();
        for (int row = 0; row < block.rows; ++row, from += block.columns)
            std::copy(from, from + block.columns, first_of(block, row));
    }

    [[nodiscard]] float* first_of(const Block& block, int row) const {
        return cells_.z + static_cast<std::ptrdiff_t>(block.row + row) * cells_.columns + block.column;
    }

    void lower_group(const PieceColumns& pieces, const Level& level, std::size_t lowest) {
        const Reach& reach = level.reach;
        float top = reach.height[lowest] < not_reached ? tool_.lower(group_, pieces[lowest]) : not_reached;
        // The lowest pieces in the middle first: after a few of them, most of the others are too high. Pieces as high as the
        // cells already are do not count; under a flat bottom there are thousands.
        order_.clear();
        for (const std::uint32_t k : level.found) {
            if (k != lowest && reach.low[k] < top) order_.emplace_back(reach.height[k], k);
        }
        // A few at a time: they lower the cells so far that hardly any of the others must be sorted.
        while (!order_.empty()) {
            const std::size_t count = std::min(order_.size(), few);
            std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count), order_.end());
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t k = order_[i].second;
                if (reach.low[k] < top) top = tool_.lower(group_, pieces[k]);
            }
            std::erase_if(order_, [&, i = std::size_t{0}](const std::pair<float, std::uint32_t>& piece) mutable {
                return i++ < count || reach.low[piece.second] >= top;
            });
        }
    }

    Outline tool_;
    CellBlock cells_;
    std::deque<Level> levels_;  // keeps its addresses
    CellGroup group_;
    std::vector<std::pair<float, std::uint32_t>> order_;
};

}  // namespace

void SweptPieces::add(const Vec3& from, const Vec3& to, double longest) {
    const Vec3 step = to - from;
    const double whole = step.head<2>().norm();
    if (!step.allFinite() || !from.allFinite()) return;
    if (whole < standing) {
        pieces_.push_back({static_cast<float>(from.x()), static_cast<float>(from.y()),
                           static_cast<float>(std::min(from.z(), to.z())), 1, 0, 0, 0});
        return;
    }
    const int count = static_cast<int>(std::ceil(whole / longest));
    const auto dx = static_cast<float>(step.x() / whole), dy = static_cast<float>(step.y() / whole);
    const auto half = static_cast<float>(0.5 * whole / count), slope = static_cast<float>(step.z() / whole);
    for (int k = 0; k < count; ++k) {
        const Vec3 middle = from + step * ((k + 0.5) / count);
        pieces_.push_back({static_cast<float>(middle.x()), static_cast<float>(middle.y()),
                           static_cast<float>(middle.z()), dx, dy, half, slope});
    }
}

double longest_piece(const CuttingTool& tool, double cell) {
    const double longest = std::max(longest_cells * cell, tool.radius / 32);
    return tool.kind == ToolKind::bull ? std::min(longest, std::max(tool.corner / corner_share, cell)) : longest;
}

void lower(const CuttingTool& tool, const SweptPieces& pieces, const CellBlock& cells) {
    Sweep(tool, cells).run(PieceColumns(pieces.all()));
}

}  // namespace clsurf

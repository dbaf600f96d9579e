#pragma once
// Adjacency: for each cutting point its neighbours on the passes to its left and right.
//
// A neighbour is the point next to the intersection of an adjacent pass with the plane through the point and normal to
// the feed. It is 0.2 … 4 step-overs away (steep flanks), and its direction is parallel or opposite (within 30°), for
// any distance of the records. Consecutive points have consecutive neighbours, so the search follows the adjacent pass
// together with the own one, and uses a grid of sparse points only if it is lost. Adjacency is a relation between
// points, not between pass numbers: a spiral is its own neighbour.

#include <cstdint>
#include <limits>

#include "core/block_fill.h"
#include "core/column.h"
#include "surface/cut_groups.h"
#include "surface/passes.h"
#include "toolpath/arc_length.h"

namespace clsurf {

enum class Side : std::uint8_t { left, right };

/// Neighbours as differences of point numbers: 32 bits suffice if adjacent passes are less than 2^31 points apart.
struct Adjacency {
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    Column<std::int32_t> left, right;  ///< neighbour − point; none: no neighbour
    /// Set for columns of a file that are checked on reading, else empty.
    BlockFillPointer checked{};

    [[nodiscard]] bool has(Side side, PointIndex i) const {
        checked.need(i);
        return column(side)[static_cast<std::size_t>(i)] != none;
    }
    /// Domain: has(side, i).
    [[nodiscard]] PointIndex neighbour(Side side, PointIndex i) const {
        return i + column(side)[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] const Column<std::int32_t>& column(Side side) const { return side == Side::left ? left : right; }
};

/// Neighbours of all points of cut passes, for a step-over [mm]; 0: there are none. `groups`: of these passes.
/// O(points), parallel over pieces of passes; the result does not depend on the number of threads.
[[nodiscard]] Adjacency find_neighbours(const Positions& positions, const Passes& passes, const ArcLength& arc_length,
                                        double step_over, const CutGroups& groups = {});

}  // namespace clsurf

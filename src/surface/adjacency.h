#pragma once
// Adjacency: for each cutting point its neighbours on the passes to its left and right.
//
// A neighbour is the point next to where the way crosses the plane through the point normal to the feed, beside it
// within 0.2 … 4 step-overs (steep flanks) and running along with it or against it (within 30°), however far apart the records are. Consecutive
// points have consecutive neighbours, so the neighbour's pass is walked along with the own one, and
// a grid of sparse points is asked only where the walk is lost. Adjacency is a relation between
// points, not between pass numbers: a spiral is its own neighbour.

#include <cstdint>
#include <limits>

#include "core/column.h"
#include "path/passes.h"
#include "path/way.h"

namespace clsurf {

enum class Side : std::uint8_t { left, right };

/// Neighbours as differences of point numbers, so that 32 bits last for any log that fits a disk
/// where neighbour passes are less than 2^31 points apart.
struct Adjacency {
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    Column<std::int32_t> left, right;  ///< neighbour − point; none: no neighbour

    [[nodiscard]] bool has(Side side, PointIndex i) const { return column(side)[static_cast<std::size_t>(i)] != none; }
    /// Domain: has(side, i).
    [[nodiscard]] PointIndex neighbour(Side side, PointIndex i) const {
        return i + column(side)[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] const Column<std::int32_t>& column(Side side) const { return side == Side::left ? left : right; }
};

/// Neighbours of all points of cut passes, for a step-over [mm]; 0: nobody has neighbours.
/// O(points), parallel over pieces of passes; the same for any number of threads.
[[nodiscard]] Adjacency find_neighbours(const Positions& positions, const Passes& passes, const Way& way,
                                        double step_over);

}  // namespace clsurf

#pragma once
// ArcLength: arc length from point to point and in total. A prefix sum for every 64th point decides in O(1) whether
// two points are far apart along the path.

#include "core/column.h"
#include "toolpath/positions.h"

namespace clsurf {

class ArcLength {
public:
    /// `positions` must outlive it if they are gathered on reading. O(points), parallel; then O(1).
    explicit ArcLength(const Positions& positions);

    /// Arc length from point i to the next [mm]; 0 from or to a missing position.
    [[nodiscard]] float step(PointIndex i) const {
        fill_.need(i);
        return steps_[static_cast<std::size_t>(i)];
    }

    /// Arc length to point 64 k, for each k, and to the end [mm].
    [[nodiscard]] const Column<double>& sums() const { return sums_; }
    /// Number of these sums.
    [[nodiscard]] static std::size_t sum_count(PointIndex points) {
        return static_cast<std::size_t>((points + stride - 1) / stride + 1);
    }

    /// Arc length from the first point to point i [mm]. O(64).
    [[nodiscard]] double to(PointIndex i) const;

    /// Whether the arc length between two points is at least `distance` [mm]. O(1) unless it is a close decision.
    [[nodiscard]] bool at_least(PointIndex i, PointIndex j, double distance) const;

    /// If positions are gathered on reading: frees the steps; they are computed again when needed. No thread may be
    /// reading.
    void forget();

private:
    static constexpr PointIndex stride = 64;

    void measure_when_read(const Positions& positions);

    Column<float> steps_;
    Column<double> sums_;  ///< arc length to point 64 k
    BlockFillPointer fill_;
};

}  // namespace clsurf

#pragma once
// SpeedScan: the fastest speeds along a given path under limits of speed and acceleration only.
//
// Between two knots the acceleration a is constant, so b = v² is linear in arc length u. With the derivatives
// of the path x′, x″ for each axis, the limits |x′ a + x″ b| ≤ A at places of a cell are linear in a and in
// the b at its start. The backward pass finds the largest b at each knot from which the rest of the path is
// feasible: a linear program in two unknowns. In the forward pass each cell uses the largest a that stays
// below. Time and memory are linear in the cells (Pham and Pham 2018, reachability analysis).

#include <limits>
#include <vector>

#include "simulation/plan/planned_motion.h"

namespace clsurf {

class SpeedScan {
public:
    void clear();
    /// Appends a cell: its length [mm], greatest speed [mm/s] and acceleration along the path [mm/s²].
    void add_cell(double length, double cap, double acceleration);
    /// Limits the speed at the start of the last cell [mm/s].
    void limit_begin(double speed);
    /// Adds the limit |slope a + bend v²| ≤ acceleration of one axis, at a place of the last cell, `at` after its start
    /// [mm]. slope has no unit, bend is in 1/mm.
    void add_limit(double at, double slope, double bend, double acceleration) {
        add_limit(cells_.size() - 1, at, slope, bend, acceleration);
    }
    /// The same for any cell, by its number from 0. O(limits of the cells after it).
    void add_limit(std::size_t number, double at, double slope, double bend, double acceleration);

    /// Finds the fastest speeds from `speed` at the first knot [mm/s] to rest at the last one. A start speed from which the
    /// limits permit no stop is lowered.
    void plan(double speed);

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    /// The speed at the knot before a cell, or after the last cell [mm/s].
    [[nodiscard]] double speed(std::size_t knot) const;
    /// The motions of a cell. If only the acceleration along the path limits it, the speed rises to the cap and falls
    /// again.
    void motions(std::size_t cell, std::vector<CellMotion>& into) const;
    /// Whether limits at places of the cell determine its motion, which then has constant acceleration.
    [[nodiscard]] bool has_limits(std::size_t cell) const { return first_row(cell) != cells_[cell].end_row; }
    /// The acceleration of such a cell [mm/s²].
    [[nodiscard]] double acceleration(std::size_t cell) const {
        return 0.5 * (squares_[cell + 1] - squares_[cell]) / cells_[cell].length;
    }
    /// Whether a motion runs at the cell's greatest speed.
    [[nodiscard]] bool at_cap(std::size_t cell, const CellMotion& motion) const;

    /// Removes the first cells.
    void drop_front(std::size_t count);

private:
    struct Cell {
        double length = 0, cap = 0, acceleration = 0;  ///< cap of b [mm²/s²]
        std::size_t end_row = 0;
        double begin_cap = std::numeric_limits<double>::infinity();  ///< of b at its start
    };
    /// |a + tilt b| ≤ width, b at the cell's start.
    struct Row {
        double width = 0, tilt = 0;
    };
    /// The least and greatest a as functions of b: the lines that are active at a given b.
    struct Line {
        double at_rest = 0, by_b = 0;
        [[nodiscard]] double at(double b) const { return at_rest + by_b * b; }
    };
    struct Bounds {
        Line low, high;
    };

    [[nodiscard]] std::size_t first_row(std::size_t cell) const { return cell > 0 ? cells_[cell - 1].end_row : 0; }
    [[nodiscard]] Bounds bounds(std::size_t cell, double b, double next) const;
    [[nodiscard]] double greatest_before(std::size_t cell, double next) const;

    std::vector<Cell> cells_;
    std::vector<Row> rows_;
    std::vector<double> squares_;  ///< b at the knots
};

}  // namespace clsurf

#pragma once
// SpeedProblem: the fastest speeds along a given path under limits of speed, acceleration and jerk.
//
// Unknown is b(u) = v², u the way, a quadratic spline with one coefficient c to a cell: then
// a = b′/2 is continuous and the jerk is √b b″/2. With the path's derivatives x′, x″, x‴, an axis each,
//
//     |x′ b′/2 + x″ b| ≤ A,      |x′ b″/2 + 3/2 x″ b′ + x‴ b| ≤ J/√b,
//
// the first linear, the second with a right side convex in b: its tangent lies below it, so that every
// step that holds the linearised limits holds the limits themselves. The time ∫ du/√b is convex.
// Solved by a primal-dual interior-point method; c being coupled to two neighbours on either side, the
// Newton matrix has five diagonals, and a step costs time linear in cells.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "machine/machine.h"

namespace clsurf {

/// Speed and tangential acceleration at a knot [mm/s, mm/s²].
struct KnotState {
    double speed = 0, acceleration = 0;
};

/// What may rule in a cell.
enum class Row : std::uint8_t { cap, tangential_acceleration, axis_acceleration, tangential_jerk, axis_jerk, corner_jerk };

/// A cell's limits of the speed [mm/s] and along the path.
struct CellLimits {
    double cap = 0, acceleration = 0, jerk = 0;
};

/// The derivatives of a bent path at a place of a cell.
struct Station {
    double at = 0;  ///< way after the cell's begin [mm]
    Vec3 slope = Vec3::Zero(), bend = Vec3::Zero(), twist = Vec3::Zero();  ///< x′, x″ [1/mm], x‴ [1/mm²]
};

class SpeedProblem {
public:
    explicit SpeedProblem(const Machine& machine) : machine_(&machine) {}

    void clear();
    /// A cell after the last one; `value`: its coefficient to begin with [mm²/s²], greater than 0.
    void add_cell(double length, double value, const CellLimits& limits);
    /// A place of the last cell where the limits of the axes are held.
    void add_station(const Station& station);

    /// The fastest speeds from one state to another. False: none was found that holds every limit, or none much
    /// faster; the values are then what they were. At least four cells.
    [[nodiscard]] bool solve(const KnotState& start, const KnotState& end);

    /// Forgets the first cells.
    void drop_front(std::size_t count);
    /// Coefficient of a cell [mm²/s²].
    [[nodiscard]] double value(std::size_t cell) const { return value_[cell + 1]; }
    /// The limit that a cell is nearest to.
    [[nodiscard]] Row ruling(std::size_t cell) const { return cells_[cell].ruling; }

    /// Coefficient of a cell from a profile's states at its two knots.
    [[nodiscard]] static double value_between(double length, const KnotState& begin, const KnotState& end);

private:
    struct Cell {
        double length = 0;
        CellLimits limits;
        std::uint32_t first_station = 0, end_station = 0, end_row = 0;
        // Rows found to be needed: of the acceleration at the end; of the jerk at begin, middle and end.
        bool acceleration = false;
        std::array<bool, 3> jerk{};
        double jerk_share = 1;  ///< of the jerk along the path, lowered where it is broken between rows
        Row ruling = Row::cap;
    };
    struct HeldStation {
        Station station;
        std::uint8_t needed = 0;  ///< a bit for the acceleration of each axis, then one for the jerk of each
    };
    /// Of the two sides of a row: w · c below, and above.
    using Sides = Eigen::Array2d;
    /// −low/√m ≤ w · c ≤ 1/√m: for a jerk m is b at its place, otherwise 1. Each side is g ≥ 0 with its slack s > 0,
    /// equal to g once a start that breaks limits has been mended, and its multiplier.
    struct Limit {
        Sides slack = Sides::Zero(), multiplier = Sides::Zero();
        Sides inverse = Sides::Zero();  ///< 1/slack at the last assemble()
        Sides slack_step = Sides::Zero(), multiplier_step = Sides::Zero();
        std::array<double, 3> w{}, v{};  ///< of the cell's three coefficients: m = unit + v · c
        double unit = 1, low = 1;
        double value = 0, root = 1, bound = 1, fall = 0;  ///< w · c; √m, 1/√m, and its derivative by m
        std::uint32_t cell = 0, number = 0;  ///< number: of its place and what it limits, in the cell
        Row kind = Row::cap;
        void follow(const double* c) {
            value = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
            root = std::sqrt(unit + v[0] * c[0] + v[1] * c[1] + v[2] * c[2]);
            bound = 1 / root;
            fall = -0.5 * bound * bound * bound;
        }
        [[nodiscard]] Sides left() const { return {bound - value, low * bound + value}; }
    };
    /// Weights of a cell's three coefficients for b, b′ and b″ at a place.
    struct Weights {
        std::array<double, 3> b{}, slope{}, curve{};
    };
    /// Greatest steps of slacks and multipliers to their limits, as 1/step; and sums over the sides.
    struct Steps {
        double primal = 0, dual = 0;
        double by_primal = 0, by_dual = 0, by_both = 0;  ///< how the gap changes with the steps taken
    };

    [[nodiscard]] bool optimise(const KnotState& start, const KnotState& end);
    void fix_ends(const KnotState& start, const KnotState& end);
    void need_likely_rows();
    [[nodiscard]] bool need_broken_rows(double part);
    void make_rows();
    void add_needed_rows();
    void add_cap(std::uint32_t number, std::size_t cell, const std::array<double, 3>& weights, double cap);
    void add_row(std::uint32_t number, Row kind, std::size_t cell, const std::array<double, 3>& w, double limit);
    void add_jerk(std::uint32_t number, Row kind, std::size_t cell, const std::array<double, 3>& w, const std::array<double, 3>& b, double limit);
    void begin(Limit& row, double centre, double slack) const;
    void advance(double primal, double dual);
    void assemble();
    [[nodiscard]] bool step();
    [[nodiscard]] bool factorise();
    void substitute();
    [[nodiscard]] Steps predict();
    [[nodiscard]] Steps correct(double centre);
    [[nodiscard]] double time() const;
    [[nodiscard]] double time_at_caps() const;
    void judge();
    [[nodiscard]] bool iterate();
    /// At begin, middle and end.
    [[nodiscard]] std::array<Weights, 3> weights_along(std::size_t cell) const;
    [[nodiscard]] Weights weights_at(std::size_t cell, double at) const;

    const Machine* machine_;
    std::vector<Cell> cells_;
    std::vector<HeldStation> stations_;
    std::vector<double> value_;  ///< of the cells, with one beyond each end
    std::vector<Limit> rows_;    ///< in the order of their cells and numbers
    std::vector<Limit> rows_before_;
    // Newton: five diagonals, right side without the barrier, its parts with centre and with products, step.
    std::vector<double> d0_, d1_, d2_, pull_, centring_, products_, step_;
    double gap_ = 0, broken_ = 0;  ///< sum of slack times multiplier; greatest part of a bound that a limit is broken by
};

}  // namespace clsurf

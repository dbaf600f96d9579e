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

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "machine/machine.h"

namespace clsurf {

/// Speed and tangential acceleration at a knot [mm/s, mm/s²].
struct KnotState {
    double speed = 0, acceleration = 0;
};

/// What may rule at a station, in the order of its rows.
enum class Row : std::uint8_t { cap, tangential_acceleration, axis_acceleration, tangential_jerk, axis_jerk, corner_jerk };

/// The path and its limits at a point of a cell.
struct Station {
    double at = 0;    ///< way after the cell's begin [mm]
    double cap = 0;   ///< of the speed [mm/s]
    double acceleration = 0, jerk = 0;  ///< tangential
    bool bent = false;                  ///< bend and twist are not zero
    bool between = false;               ///< an extra place in a bend: the tangential limits are not repeated there
    bool checked = false;               ///< only looked at when the rest is solved
    Vec3 slope = Vec3::Zero(), bend = Vec3::Zero(), twist = Vec3::Zero();  ///< x′, x″ [1/mm], x‴ [1/mm²]
};

class SpeedProblem {
public:
    explicit SpeedProblem(const Machine& machine) : machine_(&machine) {}

    void clear();
    /// A cell after the last one; `value`: its coefficient to begin with [mm²/s²], greater than 0.
    void add_cell(double length, double value);
    /// A place of the last cell where limits are held.
    void add_station(const Station& station);

    /// The fastest speeds from one state to another. False: none was found that holds every limit;
    /// the values are then what they were. At least four cells.
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
        std::uint32_t first_station = 0, end_station = 0;
        Row ruling = Row::cap;
        // Parts of the limits that are used, lowered where they are broken between stations.
        double acceleration_share = 1, jerk_share = 1;
    };
    /// One side of a row: g ≥ 0 with its slack s > 0, equal to g once a start that breaks limits has been mended, and its multiplier.
    struct Side {
        double slack = 0, multiplier = 0;
        double inverse = 0;  ///< 1/slack at the last assemble()
        double slack_step = 0, multiplier_step = 0;
    };
    /// |w · c| ≤ 1, for a jerk 1/√b at the row's place.
    struct Limit {
        double w[3];
        Side high, low;  ///< bound − w · c and bound + w · c
    };
    /// Weights of a cell's three coefficients for b, b′ and b″ at a place.
    struct Weights {
        double b[3], slope[3], curve[3];
    };
    struct Place {
        double b[3];  ///< weights of c for b
        std::uint32_t first = 0, jerks = 0, end = 0;  ///< rows; from `jerks` on of the second kind
        std::uint32_t cell = 0;
    };

    [[nodiscard]] bool optimise(const KnotState& start, const KnotState& end);
    template <typename Body>
    void for_each_row(Body&& body);
    void fix_ends(const KnotState& start, const KnotState& end);
    void make_rows();
    void begin();
    void assemble();
    [[nodiscard]] bool step();
    [[nodiscard]] bool factorise();
    void substitute();
    void set_steps(bool corrected);
    void set_step(Side& side, double g, double change, bool corrected) const;
    void correct(double centre);
    void longest_steps(double& primal, double& dual) const;
    [[nodiscard]] double gap_after(double primal, double dual) const;
    void advance(double primal, double dual);
    [[nodiscard]] double time() const;
    void judge();
    [[nodiscard]] double exceeding(const Station& station, const double* c, const Weights& weights, double& jerk) const;
    [[nodiscard]] bool lower_shares();
    [[nodiscard]] bool iterate();
    [[nodiscard]] Weights weights_at(std::size_t cell, double at) const;

    const Machine* machine_;
    std::vector<Cell> cells_;
    std::vector<Station> stations_;
    std::vector<double> value_;  ///< of the cells, with one beyond each end
    std::vector<Place> places_;
    std::vector<Limit> limits_;
    std::vector<Side> above_;    ///< of the coefficients: c above a part of what it began with
    std::vector<double> floor_;
    std::vector<Row> kinds_;     ///< of the limits
    // Newton: five diagonals, right side without the barrier, step.
    std::vector<double> d0_, d1_, d2_, pull_, step_;
    double centre_ = 0;   ///< product of slack and multiplier that is aimed at
    double sides_ = 0;    ///< their number
    double gap_ = 0, broken_ = 0;  ///< sum of the products; greatest part of a bound that a limit is broken by
};

}  // namespace clsurf

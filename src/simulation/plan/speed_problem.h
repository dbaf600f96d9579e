#pragma once
// AxisSpeedProblem: the fastest speeds along a given path under limits of speed, acceleration and jerk.
//
// The unknown is b(u) = v², where u is arc length: a quadratic spline with one coefficient c per cell. Then a
// = b′/2 is continuous and the jerk is √b b″/2. With the derivatives of the path x′, x″, x‴ for each axis,
//
//     |x′ b′/2 + x″ b| ≤ A,      |x′ b″/2 + 3/2 x″ b′ + x‴ b| ≤ J/√b.
//
// The acceleration and jerk along the rounded path have the same form as those of an axis, with |p′| and its derivatives.
// The first limit is linear. The right side of the second one is convex in b and is therefore never below its tangent:
// every step that satisfies the linearised limits satisfies the limits themselves. The time ∫ du/√b is convex. A
// primal-dual interior-point method solves the problem. Each c is coupled to two neighbours on either side, so the Newton
// matrix has five diagonals, and the time of a step is linear in the number of cells.

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/geometry.h"
#include "machine/machine.h"
#include "numeric/banded_ldlt.h"
#include "simulation/path/axis_sample.h"
#include "simulation/plan/limit_rows.h"

namespace clsurf {

/// Speed and tangential acceleration at a knot [mm/s, mm/s²].
struct KnotState {
    double speed = 0, acceleration = 0;
};

/// Limits of a cell: of the speed [mm/s], and of acceleration and jerk along the programmed path. Infinite: the samples
/// contain all limits.
struct CellLimits {
    double cap = 0, acceleration = 0, jerk = 0;
};

/// Limits of each axis, and along the path. A jerk of 0 is not limited.
template <int Axes>
struct ProblemLimits {
    AxisVector<Axes> acceleration, jerk;
    double path_acceleration = 0, path_jerk = 0;
};
[[nodiscard]] ProblemLimits<3> linear_limits(const Machine& machine);
[[nodiscard]] ProblemLimits<5> five_axis_limits(const Machine& machine);

/// The meaning of the first speeds of a problem.
enum class FirstSpeeds : std::uint8_t {
    hold,   ///< they satisfy every limit: a solution that is not faster is rejected
    guess,  ///< they may exceed limits
};

/// `Axes`: 3, or 5 with the rotary axes (speed_problem.cpp).
template <int Axes>
class AxisSpeedProblem {
public:
    using Vector = AxisVector<Axes>;
    using Sample = AxisSample<Axes>;

    explicit AxisSpeedProblem(const ProblemLimits<Axes>& limits, FirstSpeeds first = FirstSpeeds::hold)
        : limits_(limits), first_(first) {}

    void clear();
    /// Appends a cell; `value`: its first coefficient [mm²/s²], greater than 0.
    void add_cell(double length, double value, const CellLimits& limits);
    /// Adds a place of the last cell at which the limits of the axes have to be satisfied.
    void add_sample(const Sample& sample);

    /// Finds the fastest speeds from one state to another. False: no solution satisfies every limit, or none is much
    /// faster; the values are then unchanged. Needs at least four cells.
    [[nodiscard]] bool solve(const KnotState& start, const KnotState& end) { return solve(start, end, {}); }

    /// A place between the samples of a cell.
    struct Between {
        std::size_t cell = 0;
        Sample sample;
    };
    /// Returns places, in the order of cells, at which the values exceed a limit; empty: there are none.
    using LookBetween = std::function<std::vector<Between>()>;
    /// The same if derivatives vary between samples. The places that `look` finds in a solution become samples, until it
    /// finds none (an exchange method, Hettich and Kortanek 1993). After `most_looks` (speed_problem.cpp) the remaining
    /// places are ignored.
    [[nodiscard]] bool solve(const KnotState& start, const KnotState& end, const LookBetween& look);
    /// Whether the values exceed a limit of an axis, of the path, or of the speed at a place of a cell.
    [[nodiscard]] bool breaks(std::size_t cell, const Sample& sample) const {
        return broken_at(sample, at_begin(cell), 1) != 0;
    }
    /// The greatest share of any of these limits that the values use there; for the speed the share of its square.
    [[nodiscard]] double greatest_share(std::size_t cell, const Sample& sample) const;

    /// The factor, at most 1, by which v² has to be lowered everywhere, including the states at both ends, so that the
    /// values satisfy every limit at the samples.
    [[nodiscard]] double holding_share(const KnotState& start, const KnotState& end);
    /// Multiplies all values by a factor.
    void scale(double factor);

    /// Removes all cells except the first `left`.
    void drop_back(std::size_t left);
    /// Removes the first cells.
    void drop_front(std::size_t count);
    /// Coefficient of a cell [mm²/s²].
    [[nodiscard]] double value(std::size_t cell) const { return value_[cell + 1]; }
    /// The limit that a cell is nearest to.
    [[nodiscard]] Row limiting(std::size_t cell) const { return limiting_[cell]; }

    /// Coefficient of a cell from a profile's states at its two knots.
    [[nodiscard]] static double value_between(double length, const KnotState& begin, const KnotState& end);

private:
    struct Cell {
        double length = 0;
        CellLimits limits;
        std::uint32_t first_sample = 0, end_sample = 0;
        // Greatest values of its samples.
        Vector first = Vector::Zero(), second = Vector::Zero(), third = Vector::Zero();
        Pace pace{0, 0, 0};
        double least_cap = infinite_speed;  ///< of its samples
        // Rows found to be needed: acceleration at the end; jerk at start, middle and end.
        bool acceleration = false;
        std::array<bool, 3> jerk{};
        double jerk_share = 1;  ///< share of the jerk limit along the path, lowered if it is exceeded between rows
        bool changed = false;   ///< rows have become needed since the rows were made
    };
    struct HeldSample {
        Sample sample;
        /// One bit each for: the acceleration of each axis, the jerk of each axis, the acceleration of the path, its jerk,
        /// and the speed.
        std::uint16_t needed = 0;
    };
    /// Weights of a cell's three coefficients for b, b′ and b″ at a place.
    struct Weights {
        std::array<double, 3> b{}, slope{}, curve{};
    };
    /// b and its derivatives at the start of a cell.
    struct AtBegin {
        double b = 0, slope = 0, curve = 0;
    };
    struct SampleMotion;
    // speed_problem.cpp: the solution
    [[nodiscard]] bool optimise(const KnotState& start, const KnotState& end, const LookBetween& look);
    static void widen(Cell& cell, const Sample& sample);
    [[nodiscard]] bool join(const std::vector<Between>& places);
    void fix_ends(const KnotState& start, const KnotState& end);
    void lower_to_caps();
    void weigh();
    [[nodiscard]] bool iterate();
    void assemble();
    [[nodiscard]] bool step();
    [[nodiscard]] BandedDiagonals<2> free_diagonals();
    void substitute();
    [[nodiscard]] double time() const;
    [[nodiscard]] double time_at_caps() const;
    void add_needed_rows();

    // needed_rows.cpp: which limits are rows
    [[nodiscard]] double acceleration_at_end(std::size_t cell) const;
    void add_likely_rows();
    [[nodiscard]] bool add_violated_rows(double part);
    [[nodiscard]] AtBegin at_begin(std::size_t cell) const;
    [[nodiscard]] std::uint16_t broken_at(const Sample& sample, const AtBegin& at, double part) const;
    [[nodiscard]] bool may_break(const Cell& cell, double part, double acceleration, double square, double jerk,
                                 double path_jerk) const;
    void make_rows(const LimitRows* before = nullptr);
    void make_rows_of(std::size_t i);
    void add_cap(std::uint32_t number, std::size_t cell, const std::array<double, 3>& weights, double cap);
    void add_row(std::uint32_t number, Row kind, std::size_t cell, const std::array<double, 3>& w, double limit);
    void add_jerk(std::uint32_t number, Row kind, std::size_t cell, const std::array<double, 3>& w,
                  const std::array<double, 3>& b, double limit);
    /// Weights at start, middle and end.
    [[nodiscard]] std::array<Weights, 3> weights_along(std::size_t cell) const;
    [[nodiscard]] Weights weights_at(std::size_t cell, double at) const;

    ProblemLimits<Axes> limits_;
    FirstSpeeds first_;
    std::vector<Cell> cells_;
    std::vector<HeldSample> samples_;
    std::vector<Weights> begins_;  ///< weights at the start of each cell
    std::vector<double> value_;    ///< of the cells, with one more beyond each end
    std::vector<Row> limiting_;    ///< of the cells
    LimitRows rows_, rows_before_;
    NewtonSystem newton_;
    std::vector<double> step_;
    double gap_ = 0,
           broken_ = 0;  ///< sum of slack times multiplier; greatest violation of a limit, as a share of its bound
};

using SpeedProblem = AxisSpeedProblem<3>;

}  // namespace clsurf

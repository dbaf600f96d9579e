#pragma once
// AxisSpeedProblem: the fastest speeds along a given path under limits of speed, acceleration and jerk.
//
// The unknown is b(u) = v², where u is arc length: a quadratic spline with one coefficient c per cell. Then a
// = b′/2 is continuous and the jerk is √b b″/2. With the derivatives of the path x′, x″, x‴ for each axis,
//
//     |x′ b′/2 + x″ b| ≤ A,      |x′ b″/2 + 3/2 x″ b′ + x‴ b| ≤ J/√b.
//
// The acceleration and jerk along the rounded path have the same form as those of an axis, with |p′| and its
// derivatives. The first limit is linear. The second has a right side that is convex in b: its tangent lies below it, so
// every step that keeps the linearised limits keeps the limits themselves. The time ∫ du/√b is convex. A
// primal-dual interior-point method solves the problem. Each c is coupled to two neighbours on either side, so
// the Newton matrix has five diagonals, and a step costs time linear in cells.

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

/// A cell's limits of the speed [mm/s], and of acceleration and jerk along the programmed path; infinite: its samples say
/// all.
struct CellLimits {
    double cap = 0, acceleration = 0, jerk = 0;
};

/// Of each axis, and of the acceleration along the path. A jerk of 0 is not limited.
template <int Axes>
struct ProblemLimits {
    AxisVector<Axes> acceleration, jerk;
    double path_acceleration = 0, path_jerk = 0;
};
[[nodiscard]] ProblemLimits<3> linear_limits(const Machine& machine);
[[nodiscard]] ProblemLimits<5> five_axis_limits(const Machine& machine);

/// What the solution is compared with.
enum class FirstSpeeds : std::uint8_t {
    hold,   ///< the values to begin with hold every limit: a solution that is not faster is none
    guess,  ///< they need not
};

/// `Axes`: 3, or 5 with the rotary ones (speed_problem.cpp).
template <int Axes>
class AxisSpeedProblem {
public:
    using Vector = AxisVector<Axes>;
    using Sample = AxisSample<Axes>;

    explicit AxisSpeedProblem(const ProblemLimits<Axes>& limits, FirstSpeeds first = FirstSpeeds::hold)
        : limits_(limits), first_(first) {}

    void clear();
    /// A cell after the last one; `value`: its coefficient to begin with [mm²/s²], greater than 0.
    void add_cell(double length, double value, const CellLimits& limits);
    /// A place of the last cell where the limits of the axes are held.
    void add_sample(const Sample& sample);

    /// The fastest speeds from one state to another. False: none was found that holds every limit, or none much
    /// faster; the values are then what they were. At least four cells.
    [[nodiscard]] bool solve(const KnotState& start, const KnotState& end) { return solve(start, end, {}); }

    /// A place between the samples of a cell.
    struct Between {
        std::size_t cell = 0;
        Sample sample;
    };
    /// Places, in the order of cells, at which the values break a limit; none: they hold everywhere.
    using LookBetween = std::function<std::vector<Between>()>;
    /// The same where derivatives vary between samples: what `look` finds in a solution become samples, until it finds no more
    /// (an exchange method, Hettich and Kortanek 1993). After `most_looks` (speed_problem.cpp) the rest stays.
    [[nodiscard]] bool solve(const KnotState& start, const KnotState& end, const LookBetween& look);
    /// Whether the values break a limit of an axis, of the path, or of the speed at a place of a cell.
    [[nodiscard]] bool breaks(std::size_t cell, const Sample& sample) const {
        return broken_at(sample, at_begin(cell), 1) != 0;
    }
    /// The greatest share that the values take of any of these limits there; of the speed its square.
    [[nodiscard]] double greatest_share(std::size_t cell, const Sample& sample) const;

    /// The factor, at most 1, by which v² is to be lower everywhere, at the states of both ends too, so that the values hold
    /// every limit at the samples.
    [[nodiscard]] double holding_share(const KnotState& start, const KnotState& end);
    /// All values times a factor.
    void scale(double factor);

    /// Forgets all cells but the first ones.
    void drop_back(std::size_t left);
    /// Forgets the first cells.
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
        // Greatest of its samples.
        Vector first = Vector::Zero(), second = Vector::Zero(), third = Vector::Zero();
        Pace pace{0, 0, 0};
        double least_cap = infinite_speed;  ///< of its samples
        // Rows found to be needed: of the acceleration at the end; of the jerk at begin, middle and end.
        bool acceleration = false;
        std::array<bool, 3> jerk{};
        double jerk_share = 1;  ///< of the jerk along the path, lowered where it is broken between rows
        bool changed = false;   ///< rows have become needed since they were made
    };
    struct HeldSample {
        Sample sample;
        /// A bit for the acceleration of each axis, then one for the jerk of each, then for the acceleration of the path,
        /// its jerk, and the speed.
        std::uint16_t needed = 0;
    };
    /// Weights of a cell's three coefficients for b, b′ and b″ at a place.
    struct Weights {
        std::array<double, 3> b{}, slope{}, curve{};
    };
    /// b and its derivatives at the begin of a cell.
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
    void need_likely_rows();
    [[nodiscard]] bool need_broken_rows(double part);
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
    /// At begin, middle and end.
    [[nodiscard]] std::array<Weights, 3> weights_along(std::size_t cell) const;
    [[nodiscard]] Weights weights_at(std::size_t cell, double at) const;

    ProblemLimits<Axes> limits_;
    FirstSpeeds first_;
    std::vector<Cell> cells_;
    std::vector<HeldSample> samples_;
    std::vector<Weights> begins_;  ///< weights at the begin of each cell
    std::vector<double> value_;    ///< of the cells, with one beyond each end
    std::vector<Row> limiting_;    ///< of the cells
    LimitRows rows_, rows_before_;
    NewtonSystem newton_;
    std::vector<double> step_;
    double gap_ = 0,
           broken_ = 0;  ///< sum of slack times multiplier; greatest part of a bound that a limit is broken by
};

using SpeedProblem = AxisSpeedProblem<3>;

}  // namespace clsurf

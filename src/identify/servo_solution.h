#pragma once
// The parameters of a servo loop that explain an axis' records best, for given terms, and how well they are known.

#include <array>

#include "identify/servo_problem.h"

namespace clsurf {

struct ServoSolution {
    ServoParameters parameters;
    ServoSums sums;
    /// With derivatives over changes so small that they hardly move an instant at which the axis sticks or comes loose:
    /// forward and backward, since a change in one direction may still move one.
    std::array<ServoSums, 2> fine{};
    double rounding = 0;  ///< variance of the fed-back positions' rounding [unit²]

    /// Bayesian information criterion of Gaussian residuals. Rounding of doubles explains residuals below 10⁻¹⁰.
    [[nodiscard]] double criterion() const;
    /// What quantum and noise make of the residuals: the variance of their changes, at least the rounding [unit²].
    [[nodiscard]] double unexplainable() const;
};

/// The parameters with the lags A, B and C (see servo_solution.cpp) in the places of feed-forward, step and friction.
[[nodiscard]] ServoParameters loop_of_lags(ServoParameters lags, double period);

/// The reverse of loop_of_lags().
[[nodiscard]] ServoParameters lags_of_loop(ServoParameters parameters, double period);

/// A loop that a machine file may describe (io/readers/machine_file.cpp).
[[nodiscard]] bool settles(const ServoParameters& parameters, double period);

/// How far a search goes.
struct ServoEffort {
    int most_steps = 60;
    double enough = 1e-7;          ///< relative fall of the squares by which a search ends
    bool fine = true;              ///< with ever smaller differences for derivatives
    bool free_feedforward = true;  ///< it may fall below 0, which no machine file has: a bound hinders the search
};

/// Gauss–Newton with the damping of Levenberg and Marquardt. The steps are taken in the lags that the records determine
/// (ServoLags), not in the parameters, whose valleys are narrow and curved. `start` must settle.
[[nodiscard]] ServoSolution minimise(const ServoProblem& problem, const ServoParameters& start,
                                     const ServoEffort& effort);

/// The variance of the sum of the parameters times `weights`, whose residuals are correlated within groups of records. The
/// greatest of those by `sums` and by both of `fine`: derivatives that move an instant at which the axis sticks take it for an
/// exact measurement, although it is known to a period only.
[[nodiscard]] double variance_of(const ServoSolution& at, const ServoVector& weights);

/// Infinite: not identifiable.
[[nodiscard]] std::array<double, servo_terms> standard_errors(const ServoSolution& at);

}  // namespace clsurf

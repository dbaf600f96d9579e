#pragma once
// The parameters of a servo loop that explain the records of an axis best, for given terms, and their accuracy.

#include <array>

#include "identify/servo_problem.h"

namespace clsurf {

struct ServoSolution {
    ServoParameters parameters;
    ServoSums sums;
    /// With derivatives over changes so small that they hardly move an instant at which the axis sticks or comes loose.
    /// Forward and backward, because a change in one direction may still move an instant.
    std::array<ServoSums, 2> fine{};
    double rounding = 0;  ///< variance of the feedback positions from rounding [unit²]

    /// Bayesian information criterion of Gaussian residuals. Residuals below 10⁻¹⁰ count as rounding of doubles.
    [[nodiscard]] double criterion() const;
    /// The variance that quantum and noise explain: that of the residuals' changes, at least the rounding [unit²].
    [[nodiscard]] double unexplainable() const;
};

/// The parameters from the lags A, B and C (see servo_solution.cpp), which take the places of feed-forward, step and
/// friction.
[[nodiscard]] ServoParameters loop_of_lags(ServoParameters lags, double period);

/// The inverse of loop_of_lags().
[[nodiscard]] ServoParameters lags_of_loop(ServoParameters parameters, double period);

/// Whether a machine file may describe this loop (io/readers/machine_file.cpp).
[[nodiscard]] bool settles(const ServoParameters& parameters, double period);

/// Limits of a search.
struct ServoEffort {
    int most_steps = 60;
    double enough = 1e-7;          ///< relative decrease of the squares at which the search ends
    bool fine = true;              ///< repeats with ever smaller differences for derivatives
    bool free_feedforward = true;  ///< it may be below 0, which no machine file allows: a bound would hinder the search
};

/// Gauss–Newton with the damping of Levenberg and Marquardt. Steps are taken in the lags that the records determine
/// (ServoLags): in the parameters the valleys are narrow and curved. `start` must settle.
[[nodiscard]] ServoSolution minimise(const ServoProblem& problem, const ServoParameters& start,
                                     const ServoEffort& effort);

/// The variance of the sum of the parameters times `weights`, if residuals are correlated within groups of records. The
/// greatest of the values by `sums` and by both of `fine`: derivatives that move an instant at which the axis sticks treat
/// it as an exact measurement, although it is known only to a period.
[[nodiscard]] double variance_of(const ServoSolution& at, const ServoVector& weights);

/// Infinite: not identifiable.
[[nodiscard]] std::array<double, servo_terms> standard_errors(const ServoSolution& at);

}  // namespace clsurf

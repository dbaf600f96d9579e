#pragma once
// The parameters of a servo loop that explain an axis' records best, for given terms, and how well they are known.

#include <array>

#include "identify/servo_problem.h"

namespace clsurf {

struct ServoSolution {
    ServoParameters parameters;
    ServoSums sums;
    double rounding = 0;  ///< variance of the fed-back positions' rounding [unit²]

    /// Bayesian information criterion of Gaussian residuals. Rounding of doubles explains residuals below 10⁻¹⁰.
    [[nodiscard]] double criterion() const;
    /// What quantum and noise make of the residuals: the variance of their changes, at least the rounding [unit²].
    [[nodiscard]] double unexplainable() const;
};

/// A loop that a machine file may describe (io/readers/machine_file.cpp).
[[nodiscard]] bool settles(const ServoParameters& parameters, double period);

/// How far a search goes.
struct ServoEffort {
    int most_steps = 60;
    double enough = 1e-7;  ///< relative fall of the squares by which a search ends
    bool fine = true;      ///< with ever smaller differences for derivatives
};

/// Gauss–Newton with the damping of Levenberg and Marquardt. The steps are taken in the lags that the records determine
/// (ServoLags), not in the parameters, whose valleys are narrow and curved. `start` must settle.
[[nodiscard]] ServoSolution minimise(const ServoProblem& problem, const ServoParameters& start,
                                     const ServoEffort& effort);

/// The covariance of parameters whose residuals are correlated within groups of records.
[[nodiscard]] ServoMatrix covariance_of(const ServoSolution& at);

/// Infinite: not identifiable.
[[nodiscard]] std::array<double, servo_terms> standard_errors(const ServoSolution& at);

}  // namespace clsurf

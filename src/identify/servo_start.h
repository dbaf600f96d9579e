#pragma once
// First values of a servo loop: its difference equation as a linear regression (ARX), with all terms averaged over some
// records, so that rounding has less influence.

#include <vector>

#include "identify/servo_problem.h"

namespace clsurf {

struct ServoStart {
    ServoParameters parameters;
    double friction = 0;     ///< [unit/s]; not in the parameters
    double mean_square = 0;  ///< of the residual speeds of the regression
};

/// The lags A, B and C of loop_of_lags() that the records show, in the places of feed-forward, step and friction: a linear
/// regression of the following error by speed, acceleration and direction. They are valid for any loop.
[[nodiscard]] ServoParameters lags_of(const ServoProblem& problem);

/// One start per dead time of 0, 1, … `most_dead_periods` periods, the best first. Starts without a valid loop are left
/// out. O(records · most_dead_periods).
[[nodiscard]] std::vector<ServoStart> servo_starts(const ServoProblem& problem, int most_dead_periods);

}  // namespace clsurf

#pragma once
// First values of a servo loop: the loop's difference equation as a linear regression (ARX), with all terms averaged
// over some records, so that rounding counts less.

#include <vector>

#include "identify/servo_problem.h"

namespace clsurf {

struct ServoStart {
    ServoParameters parameters;
    double friction = 0;     ///< [unit/s]; the parameters have none
    double mean_square = 0;  ///< of the regression's residual speeds
};

/// One start a dead time of 0, 1, … `most_dead_periods` periods, the best first. Those that are no loop are left out.
/// O(records · most_dead_periods).
/// The lags A, B and C of loop_of_lags() that the records show, in the places of feed-forward, step and friction: a linear
/// regression of the following error by speed, acceleration and direction. They are right whatever the loop is.
[[nodiscard]] ServoParameters lags_of(const ServoProblem& problem);

[[nodiscard]] std::vector<ServoStart> servo_starts(const ServoProblem& problem, int most_dead_periods);

}  // namespace clsurf

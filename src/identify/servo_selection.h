#pragma once
// Which of friction, backlash, dead time and an integrating velocity loop an axis has.

#include <array>
#include <span>
#include <vector>

#include "identify/servo_solution.h"
#include "identify/servo_start.h"

namespace clsurf {

/// Standard errors above zero from which an optional term is certain.
inline constexpr double certain_errors = 4;

/// What an additional term of the loop explains.
struct TermEvidence {
    ServoTerm term = ServoTerm::friction;
    double value = 0;   ///< as ServoParameters has it
    double gain = 0;    ///< by how much the Bayesian information criterion falls with it
    bool kept = false;  ///< it falls, and the value exceeds `certain_errors` standard errors
};

struct SelectedLoop {
    ServoSolution solution;
    std::vector<TermEvidence> evidence;  ///< of each term
    /// See standard_errors(); with what other loops that explain the records would change.
    std::array<double, servo_terms> standard_error{};
};

/// The loop with the terms that the records show. Terms hide each other, so every combination of them is searched, from several
/// starts, on a part of the records; the best are then compared on all of them, and terms that have become unnecessary are
/// removed again. `rounding`: variance of the fed-back positions [unit²].
[[nodiscard]] SelectedLoop select_loop(const ServoProblem& problem, std::span<const ServoStart> regressions,
                                       double rounding);

}  // namespace clsurf

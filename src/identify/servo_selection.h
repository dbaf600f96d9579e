#pragma once
// Selects which of friction, backlash, dead time and an integrating velocity loop an axis has.

#include <array>
#include <span>
#include <vector>

#include "identify/servo_solution.h"
#include "identify/servo_start.h"

namespace clsurf {

/// Number of standard errors above zero from which an optional term is certain (docs/identify.md#servo-loops).
inline constexpr double certain_errors = 4;

/// The evidence for an additional term of the loop.
struct TermEvidence {
    ServoTerm term = ServoTerm::friction;
    double value = 0;  ///< as in ServoParameters
    double gain = 0;   ///< decrease of the Bayesian information criterion with the term
};

struct SelectedLoop {
    ServoSolution solution;
    std::vector<TermEvidence> evidence;  ///< of each term
    /// As standard_errors(), widened by the differences to other loops that explain the records.
    std::array<double, servo_terms> standard_error{};
};

/// The loop with the terms that the records show. Terms hide each other. Therefore every combination of them is searched,
/// from several starts, on a part of the records. The best combinations are then compared on all records, and terms that
/// have become unnecessary are removed. `rounding`: variance of the feedback positions [unit²].
[[nodiscard]] SelectedLoop select_loop(const ServoProblem& problem, std::span<const ServoStart> regressions,
                                       double rounding);

}  // namespace clsurf

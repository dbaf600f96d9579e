#pragma once
// Limits that the motion itself does not show, from how well simulations explain the runs.

#include <optional>
#include <string>
#include <vector>

#include "identify/identification.h"
#include "identify/rule_search.h"

namespace clsurf {

/// Limits of `result` that are lower bounds may hold back the simulation together, so that a greater value of one alone explains
/// nothing. Where four times the values of all of them, or of those of the path, explain the runs decisively better, the machine
/// has those from then on. A trapezoidal planner is left alone: its rules search the accelerations of its axes. O(records) for at
/// most two values and one a limit.
void free_limits(RuleScores& scores, Identification& result);

/// Searches each acceleration and jerk that `result` has as a lower bound, again until none changes, and puts the values that
/// explain the runs best into its machine. Nothing is searched on five axes: their simulations take too long. Another value must lower the mean error of the speed by the share `least_gain`, unless the
/// machine explains the runs with it. O(records) for each of some 20 values of a limit that the runs depend on, and for 3 of
/// any other.
void search_limits(double least_gain, RuleScores& scores, Identification& result);

/// What simulations tell of a limit, all others as they are. Values are in the unit of the machine file.
struct SimulatedLimit {
    std::string key, of;  ///< of the machine file
    double best = 0;      ///< that of the machine
    /// Below and above these, the criterion of identify_rules() exceeds that of the best value by 10, and the mean difference of
    /// speed grows by what the best one leaves unexplained; nothing: nowhere.
    std::optional<double> lowest, highest;
    bool explains = false;  ///< the machine, the runs
    bool exact = false;     ///< the same, to what a model resolves
};

/// The intervals of all limits that `result` has as lower bounds: slices of the likelihood. Where an end is missing, the
/// limit is not identifiable in that direction (Raue et al. 2009, Bioinformatics 25, 1923). O(records) for each of some 10
/// values of a limit.
[[nodiscard]] std::vector<SimulatedLimit> limit_intervals(RuleScores& scores, const Identification& result);

/// States the limits that were found in the parameters of `result`: those with both ends as values with standard errors, those with
/// a lowest value as greater lower bounds.
void state_limits(const std::vector<SimulatedLimit>& limits, Identification& result);

}  // namespace clsurf

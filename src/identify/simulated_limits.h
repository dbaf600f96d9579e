#pragma once
// Limits that the motion itself does not show, found by how well simulations explain the runs.

#include <optional>
#include <string>
#include <vector>

#include "identify/identification.h"
#include "identify/rule_search.h"

namespace clsurf {

/// Several lower bounds in `result` may slow the simulation together, so that raising one of them explains nothing. If four
/// times the values of all of them, or of those of the path, explain the runs decisively better, the machine gets these
/// values. Not used for a trapezoidal planner: its rules search the accelerations of its axes. O(records) for at most two
/// values, and for one per limit.
void free_limits(RuleScores& scores, Identification& result);

/// Searches each acceleration and jerk that is a lower bound in `result`, until none changes, and puts the values that
/// explain the runs best into its machine. Nothing is searched on five axes: their simulations take too long. Another value
/// must lower the mean error of the speed by the share `least_gain`, unless the machine explains the runs with it.
/// O(records) for each of about 20 values of a limit that affects the runs, and for 3 values of any other limit.
void search_limits(double least_gain, RuleScores& scores, Identification& result);

/// What simulations show of a limit, with all others unchanged. Values are in the unit of the machine file.
struct SimulatedLimit {
    std::string key, of;  ///< of the machine file
    double best = 0;      ///< value in the machine
    /// Outside these bounds the criterion of identify_rules() exceeds that of the best value by 10, and the mean difference
    /// of speed grows by what the best value leaves unexplained. nullopt: no such bound.
    std::optional<double> lowest, highest;
    bool explains = false;  ///< the machine explains the runs
    bool exact = false;     ///< the machine explains the runs to the resolution of a model
};

/// The intervals of all limits that are lower bounds in `result`: slices of the likelihood. If an end is missing, the limit
/// is not identifiable in that direction (Raue et al. 2009, Bioinformatics 25, 1923). O(records) for each of about 10
/// values of a limit.
[[nodiscard]] std::vector<SimulatedLimit> limit_intervals(RuleScores& scores, const Identification& result);

/// Writes the limits that were found into the parameters of `result`. Limits with both ends become values with standard
/// errors, limits with only a lowest value become greater lower bounds.
void state_limits(const std::vector<SimulatedLimit>& limits, Identification& result);

}  // namespace clsurf

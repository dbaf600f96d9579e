#pragma once
// The rules of the planner, selected by how well they explain the runs.

#include <span>

#include "identify/identification.h"
#include "identify/run_fidelity.h"

namespace clsurf {

/// Simulates every value of every rule and keeps the one that explains the speed along the path best. Values that the runs
/// cannot distinguish are listed in `unidentified`, and the rule keeps its value. The score is the Bayesian information
/// criterion of Laplace-distributed differences of speed, the means of 32 records each, without its penalty: values of one rule
/// have the same number of free values, and families of planners differ by a few, each of which would count ln(samples).
/// Accelerations and jerks that are lower bounds are searched between the passes over all rules
/// (simulated_limits.h). Long runs that exceed 2·10^5 records in total are left out. Returns false, with `result`
/// unchanged, if no simulation shares a part of the path with a run. O(records) per candidate.
[[nodiscard]] bool identify_rules(std::span<const RecordedRun> runs, Identification& result);

}  // namespace clsurf

#pragma once
// A machine from its logs: `clsurf identify`.

#include <span>
#include <string>
#include <vector>

#include "identify/identification.h"
#include "identify/identify_run.h"
#include "pipeline/part.h"

namespace clsurf {

/// The values that the runs determine. `known` holds what is known already; what is identified replaces it. Runs must
/// have one period. Throws InputError: periods differ, or nothing can be identified. O(records), parallel.
[[nodiscard]] Identification identify(std::span<const IdentifyRun> runs, const Machine& known);

/// The same of programs with their logs, with the rules of the planner and the fidelity of the fit. Throws what identify()
/// throws.
[[nodiscard]] Identification identify_parts(std::span<const Part> parts, const Machine& known);

/// Why runs cannot be compared with simulations; empty: they can.
[[nodiscard]] std::string why_not_simulated(std::span<const Part> parts, const Machine& known);

/// Of two or more runs each is simulated with what the others give. Leaves the parts in their order. Throws what
/// identify() throws where the others give nothing.
void cross_validate(std::vector<Part>& parts, const Machine& known, Identification& result);

/// Simulates runs that were not used with the machine found. A run that cannot be compared with its simulation is named in
/// `result.unidentified`, with the reason.
void test_runs(std::span<const Part> parts, Identification& result);

}  // namespace clsurf

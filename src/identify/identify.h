#pragma once
// Identifies a machine from its logs: `clsurf identify`.

#include <span>
#include <string>
#include <vector>

#include "identify/identification.h"
#include "identify/identify_run.h"
#include "pipeline/part.h"

namespace clsurf {

/// The values that the runs determine. `known` contains the values known so far; identified values replace them. The
/// period is the shortest of the runs. Throws InputError: nothing can be identified. O(records), parallel.
[[nodiscard]] Identification identify(std::span<const IdentifyRun> runs, const Machine& known);

/// The same for programs with their logs, including the rules of the planner and the fidelity of the fit. Throws what
/// identify() throws.
[[nodiscard]] Identification identify_parts(std::span<const Part> parts, const Machine& known);

/// The reason why runs cannot be compared with simulations; empty: they can.
[[nodiscard]] std::string why_not_simulated(std::span<const Part> parts, const Machine& known);

/// For two or more runs: simulates each run with the values that the others give. Keeps the order of the parts. Throws what
/// identify() throws if the others give nothing.
void cross_validate(std::vector<Part>& parts, const Machine& known, Identification& result);

/// Simulates runs that the fit did not use, with the identified machine. Runs that cannot be compared with their simulation
/// are listed in `result.unidentified`, with the reason.
void test_runs(std::span<const Part> parts, Identification& result);

}  // namespace clsurf

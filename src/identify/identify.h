#pragma once
// A machine from its logs: `clsurf identify`.

#include <span>

#include "identify/identification.h"
#include "identify/identify_run.h"

namespace clsurf {

/// The values that the runs determine. `known` holds what is known already; what is identified replaces it. Runs must
/// have one period. Throws InputError: periods differ, or nothing can be identified. O(records), parallel.
[[nodiscard]] Identification identify(std::span<const IdentifyRun> runs, const Machine& known);

}  // namespace clsurf

#pragma once
// A machine from its logs: `clsurf identify`.

#include <span>

#include "identify/identification.h"
#include "log/log.h"
#include "mapping/line_map.h"

namespace clsurf {

struct IdentifyRun {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;  ///< nullptr: which motions are rapids is not known
};

/// The values that the runs determine. `known` holds what is known already; what is identified replaces it. Runs must
/// have one period. Throws InputError: periods differ, or nothing can be identified. O(records), parallel.
[[nodiscard]] Identification identify(std::span<const IdentifyRun> runs, const Machine& known);

}  // namespace clsurf

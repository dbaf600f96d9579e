#pragma once
// FleetRunner: judges the units of a fleet, each in a process of its own, so that a run that fails, or needs too much
// memory, ends nothing but itself.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/history/fleet_units.h"
#include "cli/progress_bar.h"

namespace clsurf::cli {

struct FleetRules {
    std::string database;
    std::size_t jobs = 1;
    std::uint64_t memory = 0;   ///< [bytes] for all of them; 0: no limit
    bool retry_failed = false;  ///< runs that failed before are tried again
};

struct FailedUnit {
    std::size_t unit = 0;
    std::string cause;
};

/// What became of the units; `skipped` of them were recorded already, and count as what they were recorded as. `repeated`
/// have the content and the parameters of one before, are the same row, and are not among the runs.
struct FleetResult {
    std::size_t runs = 0, repeated = 0, skipped = 0, judged = 0, over_budget = 0, not_judged = 0;
    std::vector<FailedUnit> failed;
};

/// Judges all units that the database does not have as they are now: same content, same settings. Throws SystemError,
/// InputError of the database.
[[nodiscard]] FleetResult run_fleet(const std::vector<FleetUnit>& units, const FleetRules& rules,
                                    const CommonOptions& common);

}  // namespace clsurf::cli

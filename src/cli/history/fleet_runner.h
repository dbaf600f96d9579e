#pragma once
// FleetRunner: judges each unit of a fleet in a separate process, so that a run that fails, or needs too much
// memory, ends only its own process.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/history/fleet_units.h"
#include "cli/progress_bar.h"

namespace clsurf::cli {

struct FleetRules {
    std::string database;
    std::size_t jobs = 1;
    std::uint64_t memory = 0;   ///< [bytes] for all processes; 0: no limit
    bool retry_failed = false;  ///< repeat runs that failed before
};

struct FailedUnit {
    std::size_t unit = 0;
    std::string cause;
};

/// The results of the units. `skipped` units were recorded already, and count as recorded. `repeated` ones
/// have the content and parameters of an earlier unit, share its row, and are not among the runs.
struct FleetResult {
    std::size_t runs = 0, repeated = 0, skipped = 0, judged = 0, over_budget = 0, not_judged = 0;
    std::vector<FailedUnit> failed;
};

/// Judges all units that the database does not have with the same content and settings. Throws SystemError,
/// InputError of the database.
[[nodiscard]] FleetResult run_fleet(const std::vector<FleetUnit>& units, const FleetRules& rules,
                                    const CommonOptions& common);

}  // namespace clsurf::cli

#pragma once
// The results of the runs of a fleet.

#include <string>
#include <vector>

namespace clsurf::io {

struct FleetFailure {
    std::string program, log, cause;
};

struct FleetReport {
    std::string database;
    std::size_t runs = 0, repeated = 0, skipped = 0, judged = 0, over_budget = 0, not_judged = 0;
    std::vector<FleetFailure> failed;
};

[[nodiscard]] std::string fleet_text(const FleetReport& report);
/// Keys: database, runs, repeated, already_recorded, judged, over_budget, not_judged, failed[] of program, log, cause.
[[nodiscard]] std::string fleet_json(const FleetReport& report);

struct MergeReport {
    std::size_t databases = 0, taken = 0, runs = 0;
};
/// Keys: databases, taken, runs.
[[nodiscard]] std::string merge_json(const MergeReport& report);

}  // namespace clsurf::io

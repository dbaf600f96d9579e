#include "io/reports/fleet_report.h"

#include <fmt/format.h>

#include "io/files/json_value.h"

namespace clsurf::io {

std::string fleet_text(const FleetReport& r) {
    std::string text =
        fmt::format("{} run{} in {}: {} judged, {} of them over their limits, {} not judged, {} failed", r.runs,
                    r.runs == 1 ? "" : "s", r.database, r.judged, r.over_budget, r.not_judged, r.failed.size());
    if (r.skipped > 0)
        text += fmt::format("; {} of the {} {} recorded already", r.skipped, r.runs, r.skipped == 1 ? "was" : "were");
    if (r.repeated > 0)
        text += fmt::format("; {} more {} the content of one of these", r.repeated, r.repeated == 1 ? "has" : "have");
    text += "\n";
    for (const FleetFailure& f : r.failed)
        text += fmt::format("  failed: {} {}: {}\n", f.program.empty() ? "-" : f.program, f.log, f.cause);
    return text;
}

std::string fleet_json(const FleetReport& r) {
    Json failed = Json::array();
    for (const FleetFailure& f : r.failed)
        failed.push_back({{"program", f.program}, {"log", f.log}, {"cause", f.cause}});
    return dump(Json{{"database", r.database},
                     {"runs", r.runs},
                     {"repeated", r.repeated},
                     {"already_recorded", r.skipped},
                     {"judged", r.judged},
                     {"over_budget", r.over_budget},
                     {"not_judged", r.not_judged},
                     {"failed", std::move(failed)}});
}

std::string merge_json(const MergeReport& r) {
    return dump(Json{{"databases", r.databases}, {"taken", r.taken}, {"runs", r.runs}});
}

}  // namespace clsurf::io

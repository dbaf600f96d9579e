// SARIF 2.1.0 (OASIS, Static Analysis Results Interchange Format): a defect is a result at the lines of
// its first run; its other runs and the passes beside it are related locations.

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/units.h"
#include "io/json_value.h"
#include "io/quality_report.h"
#include "io/sarif.h"

namespace clsurf::io {
namespace {

std::string_view level_of(int severity) { return severity >= 3 ? "error" : severity == 2 ? "warning" : "note"; }

Json location(const std::string& uri, const DefectRun& run, const std::string& message) {
    return sarif_location(uri, run.first_line, run.last_line, message);
}

std::string message_of(const Defect& d) {
    return fmt::format(
        "Predicted {} of {:.1f} µm at X {:.2f} Y {:.2f} Z {:.2f} mm over {:.1f} mm: pass {} {}; speed {:+.0f} mm/min ({:.1f} %) against its neighbours.",
        d.pit ? "pit" : "bulge", d.depth * um_per_mm, d.position.x(), d.position.y(), d.position.z(), d.length,
        d.runs.empty() ? 0 : d.runs.front().pass, description_of(d.cause), d.speed_jump * seconds_per_minute,
        100 * d.speed_mismatch);
}

}  // namespace

std::string quality_sarif(const ReportedQuality& q) {
    const std::string uri = sarif_uri(q.program->main().name());
    std::set<Cause> causes;
    for (const Defect& d : q.report->defects) causes.insert(d.cause);
    Json rules = Json::array();
    for (const Cause cause : causes) {
        rules.push_back({{"id", name_of(cause)},
                         {"shortDescription", {{"text", fmt::format("The pass {}", description_of(cause))}}}});
    }
    Json results = Json::array();
    for (std::size_t i = 0; i < q.report->defects.size(); ++i) {
        const Defect& d = q.report->defects[i];
        Json related = Json::array();
        for (std::size_t k = 1; k < d.runs.size(); ++k)
            related.push_back(location(uri, d.runs[k], fmt::format("the same defect on pass {}", d.runs[k].pass)));
        for (const DefectRun& run : d.neighbours)
            related.push_back(location(uri, run, fmt::format("pass {} beside it", run.pass)));
        for (std::size_t k = 0; k < related.size(); ++k) related[k]["id"] = k + 1;
        Json result{
            {"ruleId", name_of(d.cause)},
            {"ruleIndex", std::distance(causes.begin(), causes.find(d.cause))},
            {"level", level_of(d.severity)},
            {"message", {{"text", message_of(d)}}},
            {"locations", Json::array({location(uri, d.runs.empty() ? DefectRun{} : d.runs.front(), "")})},
            {"rank", number(std::min(100.0, 25.0 * d.severity))},
            {"properties",
             {{"id", i + 1}, {"severity", d.severity}, {"depth_um", number(d.depth * um_per_mm)}, {"log", q.log}}}};
        if (!related.empty()) result["relatedLocations"] = std::move(related);
        results.push_back(std::move(result));
    }
    Json notifications = Json::array();
    if (!q.report->judgement.judged()) {
        rules.push_back({{"id", "not_judged"}, {"shortDescription", {{"text", "The data do not allow a verdict"}}}});
        for (const std::string& reason : q.report->judgement.reasons) {
            notifications.push_back({{"level", "error"}, {"message", {{"text", "Not judged: " + reason}}}});
            results.push_back({{"ruleId", "not_judged"},
                               {"ruleIndex", rules.size() - 1},
                               {"level", "error"},
                               {"message", {{"text", "Not judged: " + reason}}},
                               {"locations", Json::array({sarif_location(uri, 0, 0, "")})}});
        }
    }
    return sarif_text(std::move(rules), std::move(results), std::move(notifications));
}

}  // namespace clsurf::io

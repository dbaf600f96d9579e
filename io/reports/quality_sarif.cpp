// SARIF 2.1.0 (OASIS, Static Analysis Results Interchange Format): a defect is a result at the lines of
// its first section; its other sections and the adjacent passes are related locations. A section inside a subprogram is at
// the subprogram's lines, and the line that calls it is a related location.

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/file_name.h"
#include "core/units.h"
#include "io/files/json_value.h"
#include "io/reports/defect_fingerprint.h"
#include "io/reports/limit_reports.h"
#include "io/reports/quality_report.h"
#include "io/reports/quality_words.h"
#include "io/reports/sarif.h"

namespace clsurf::io {
namespace {

constexpr std::size_t most_related = 20;  ///< locations: a systematic lag has hundreds

std::string_view level_of(int severity) { return severity >= 4 ? "error" : severity >= 2 ? "warning" : "note"; }

/// The path of a subprogram's file, whose name in a section has no folder.
std::string path_of(const Program& program, const std::string& file) {
    for (const SourceText& text : program.files) {
        if (file_name(text.name()) == file) return text.name();
    }
    return file;
}

Json location(const Program& program, const DefectSection& section, const std::string& message) {
    if (section.file.empty())
        return sarif_location(sarif_uri(program.main().name()), section.first_line, section.last_line, message);
    return sarif_location(sarif_uri(path_of(program, section.file)), section.file_first_line, section.file_last_line,
                          message);
}

std::string message_of(const Defect& d) {
    return fmt::format("{} at the {} {} mm. Severity {} ({}), {:.1f} times the threshold.", sentence_of(d),
                       d.place.contact ? "contact point" : "tool tip", axes_text(d.place.position()), d.severity,
                       name_of_severity(d.severity), d.score);
}

std::string markdown_of(const Defect& d) {
    return fmt::format(
        "**{}** (severity {}, {:.1f} × threshold): {}\n\n| depth | speed | length | place [mm] |\n|---|---|---|---|\n"
        "| {} | {} % ({} mm/min) | {:.1f} mm | {} |\n",
        name_of_severity(d.severity), d.severity, d.score, sentence_of(d), depth_text(d),
        signed_text(100 * d.speed_mismatch, 1), signed_text(d.speed_jump * seconds_per_minute, 0), d.length,
        axes_text(d.place.position()));
}

/// The user has accepted the defect: SARIF counts such results as suppressed.
Json suppressions_of(const Acceptance& acceptance, std::size_t i) {
    Json suppression{{"kind", "external"}, {"status", "accepted"}};
    if (!acceptance.of_defect[i].comment.empty()) suppression["justification"] = acceptance.of_defect[i].comment;
    return Json::array({std::move(suppression)});
}

std::string_view baseline_state(DefectState state) {
    return state == DefectState::fresh ? "new" : state == DefectState::worse ? "updated" : "unchanged";
}

Json rule_json(const RuleText& rule) {
    return {{"id", rule.id},
            {"shortDescription", {{"text", rule.what}}},
            {"help", {{"text", rule.help}, {"markdown", rule.help}}}};
}

/// `sections`: strongest_first(d).
Json related_locations(const Program& program, const Defect& d, std::span<const DefectSection> sections) {
    Json related = Json::array();
    if (!sections.empty() && !sections.front().file.empty()) {
        const DefectSection& section = sections.front();
        related.push_back(sarif_location(sarif_uri(program.main().name()), section.first_line, section.last_line,
                                         fmt::format("Calls {}.", section.file)));
    }
    for (std::size_t k = 1; k < std::min(sections.size(), most_related); ++k)
        related.push_back(location(program, sections[k], fmt::format("The same defect on pass {}.", sections[k].pass)));
    for (std::size_t k = 0; k < std::min(d.neighbours.size(), most_related); ++k)
        related.push_back(
            location(program, d.neighbours[k], fmt::format("Neighbouring pass {}.", d.neighbours[k].pass)));
    for (std::size_t k = 0; k < related.size(); ++k) related[k]["id"] = k + 1;
    return related;
}

/// Why the data do not allow a verdict: a rule, results and notifications.
void add_not_judged(const ReportedQuality& q, Json& rules, Json& results, Json& notifications) {
    const std::string uri = sarif_uri(q.program->main().name());
    rules.push_back(
        {{"id", "not_judged"},
         {"shortDescription", {{"text", "The data do not allow a verdict."}}},
         {"help",
          {{"text",
            "Check that the log belongs to the program, holds whole passes, and was recorded every few milliseconds."}}}});
    for (const std::string& reason : q.report->judgement.reasons) {
        notifications.push_back({{"level", "error"}, {"message", {{"text", "Not judged: " + reason}}}});
        results.push_back({{"ruleId", "not_judged"},
                           {"ruleIndex", rules.size() - 1},
                           {"level", "error"},
                           {"message", {{"text", "Not judged: " + reason}}},
                           {"locations", Json::array({sarif_location(uri, 0, 0, "")})}});
    }
}

}  // namespace

std::string quality_sarif(const ReportedQuality& q) {
    const std::vector<Defect>& defects = q.report->defects;
    Json rules = Json::array();
    std::map<std::string_view, std::size_t> index_of_rule;
    for (const Defect& d : defects) {
        if (index_of_rule.try_emplace(rule_of(d).id, rules.size()).second) rules.push_back(rule_json(rule_of(d)));
    }
    const std::vector<std::string> fingerprints = fingerprints_of(defects);
    Json results = Json::array();
    for (std::size_t i = 0; i < defects.size(); ++i) {
        const Defect& d = defects[i];
        const std::vector<DefectSection> sections = strongest_first(d);
        const std::string_view rule = rule_of(d).id;
        Json result{
            {"ruleId", rule},
            {"ruleIndex", index_of_rule.at(rule)},
            {"level", level_of(d.severity)},
            {"message", {{"text", message_of(d)}, {"markdown", markdown_of(d)}}},
            {"locations",
             Json::array({location(*q.program, sections.empty() ? DefectSection{} : sections.front(), "")})},
            {"rank", number(100.0 * static_cast<double>(defects.size() - i) / static_cast<double>(defects.size()), 1)},
            {"partialFingerprints", {{"clsurfDefect/v1", fingerprints[i]}}},
            {"properties",
             {{"id", i + 1},
              {"severity", d.severity},
              {"score", number(static_cast<double>(d.score), 2)},
              {"depth_um", number(d.depth * um_per_mm, 2)},
              {"shape", shape_of(d)},
              {"speed_jump_percent", number(100 * d.speed_mismatch, 1)},
              {"log", q.log}}}};
        add_place(result["properties"], d.place);
        Json lines = Json::array();
        for (const DefectSection& section : d.sections)
            lines.push_back(Json::array({section.first_line, section.last_line}));
        result["properties"].update(
            {{"cause", name_of(d.cause)}, {"systematic", d.systematic}, {"lines", std::move(lines)}});
        if (q.baseline != nullptr) result["baselineState"] = baseline_state(q.baseline->states[i]);
        Json related = related_locations(*q.program, d, sections);
        if (!related.empty()) result["relatedLocations"] = std::move(related);
        if (q.acceptance != nullptr && q.acceptance->accepts(i))
            result["suppressions"] = suppressions_of(*q.acceptance, i);
        results.push_back(std::move(result));
    }
    if (q.limits != nullptr) add_limits_sarif(*q.limits, *q.program, q.log, rules, results);
    Json notifications = Json::array();
    if (!q.report->judgement.judged()) add_not_judged(q, rules, results, notifications);
    return sarif_text(std::move(rules), std::move(results), std::move(notifications));
}

}  // namespace clsurf::io

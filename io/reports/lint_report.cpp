#include "io/reports/lint_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/units.h"
#include "io/reports/quality_words.h"
#include "io/reports/sarif.h"
#include "lint/lint.h"
#include "lint/lint_rule.h"

namespace clsurf::io {
namespace {

std::string lines_text(LineNumber first, LineNumber last) {
    return first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last);
}

Json finding_json(const LintFinding& f) {
    const LintUnit& unit = f.rule->unit;
    Json json{{"rule", f.rule->name},
              {"severity", name_of(f.severity)},
              {"lines", Json::array({f.first_line, f.last_line})},
              {"beside_lines", f.beside_first > 0 ? Json::array({f.beside_first, f.beside_last}) : Json(nullptr)},
              {"pass", f.pass > 0 ? Json(f.pass) : Json(nullptr)},
              {"found", number(f.found * unit.per_inside, unit.digits + 1)},
              {"expected", number(f.expected * unit.per_inside, unit.digits + 1)},
              {"unit", unit.name},
              {"text", message_of(f)}};
    add_place(json, f.place);
    return json;
}

}  // namespace

std::string lint_text(const ReportedLint& l) {
    const LintReport& r = *l.report;
    std::string text;
    for (const LintFinding& f : r.findings) {
        text += fmt::format("{}:{}: {}: {} [{}]", l.program->main().name(), lines_text(f.first_line, f.last_line),
                            name_of(f.severity), message_of(f), f.rule->name);
        if (f.beside_first > 0) text += fmt::format(", next to lines {}", lines_text(f.beside_first, f.beside_last));
        text += fmt::format(", {}\n", place_text(f.place));
    }
    if (r.not_finishing > 0.5)
        return text +
               fmt::format(
                   "no finishing passes to judge: {:.0f} % of the cutting is pockets, drilling or single contours\n",
                   100 * r.not_finishing);
    text += r.findings.empty()
                ? "nothing found"
                : fmt::format("\n{} {}", r.findings.size(), r.findings.size() == 1 ? "finding" : "findings");
    text += fmt::format(" on {} passes", r.passes);
    if (r.step_over > 0) text += fmt::format(", {:.3g} mm apart", r.step_over);
    text += fmt::format("; lines usually {:.3g} mm long, chord error {:.2f} µm (95th percentile)", r.spacing,
                        r.chord_error * um_per_mm);
    text += r.tolerance > 0 ? fmt::format(", tolerance of the controller {:.1f} µm\n", r.tolerance * um_per_mm)
                            : ", tolerance of the controller not known\n";
    if (r.step_over <= 0) text += "no adjacent passes: nothing to compare\n";
    return text;
}

std::string lint_json(const ReportedLint& l) {
    const LintReport& r = *l.report;
    Json findings = Json::array();
    for (const LintFinding& f : r.findings) findings.push_back(finding_json(f));
    Json by_rule;
    for (const LintRule& rule : r.rules) by_rule[std::string(rule.name)] = r.count(rule.name);
    Json summary{{"passes", r.passes},
                 {"step_over_mm", number(r.step_over, 5)},
                 {"judged", r.judged()},
                 {"not_finishing_percent", number(100 * r.not_finishing, 3)},
                 {"spacing_mm", number(r.spacing, 5)},
                 {"chord_error_um", number(r.chord_error * um_per_mm, 3)},
                 {"tolerance_um", r.tolerance > 0 ? number(r.tolerance * um_per_mm, 3) : Json(nullptr)},
                 {"findings", r.findings.size()},
                 {"warnings", r.warnings()},
                 {"by_rule", std::move(by_rule)}};
    return dump(Json{
        {"findings", std::move(findings)}, {"summary", std::move(summary)}, {"diagnostics", list(*l.diagnostics)}});
}

std::string lint_sarif(const ReportedLint& l) {
    const std::string uri = sarif_uri(l.program->main().name());
    std::vector<const LintRule*> broken;
    Json rules = Json::array();
    for (const LintRule& rule : l.report->rules) {
        if (l.report->count(rule.name) == 0) continue;
        broken.push_back(&rule);
        rules.push_back({{"id", rule.name}, {"shortDescription", {{"text", rule.description}}}});
    }
    Json results = Json::array();
    for (const LintFinding& f : l.report->findings) {
        Json result{{"ruleId", f.rule->name},
                    {"ruleIndex", std::find(broken.begin(), broken.end(), f.rule) - broken.begin()},
                    {"level", name_of(f.severity)},
                    {"message", {{"text", fmt::format("{}, {}", message_of(f), place_text(f.place))}}},
                    {"locations", Json::array({sarif_location(uri, f.first_line, f.last_line, "")})}};
        add_place(result["properties"], f.place);
        if (f.beside_first > 0) {
            Json beside = sarif_location(uri, f.beside_first, f.beside_last, "the adjacent pass");
            beside["id"] = 1;
            result["relatedLocations"] = Json::array({std::move(beside)});
        }
        results.push_back(std::move(result));
    }
    return sarif_text(std::move(rules), std::move(results));
}

}  // namespace clsurf::io

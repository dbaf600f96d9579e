#include "io/reports/lint_report.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/counted.h"
#include "core/units.h"
#include "io/reports/json_text.h"
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

std::string finding_text(const std::string& program, const LintFinding& f) {
    std::string text = fmt::format("{}:{}: {}: {} [{}]", program, lines_text(f.first_line, f.last_line),
                                   name_of(f.severity), message_of(f), f.rule->name);
    if (f.beside_first > 0) text += fmt::format(", next to lines {}", lines_text(f.beside_first, f.beside_last));
    return text + fmt::format(", {}\n", place_text(f.place));
}

std::int64_t notes_of(const LintReport& r) { return std::ssize(r.findings) - static_cast<std::int64_t>(r.warnings()); }

/// "12 warnings and 1 note", or "nothing found".
std::string counts_text(const LintReport& r) {
    const std::int64_t notes = notes_of(r), warnings = std::ssize(r.findings) - notes;
    if (r.findings.empty()) return "nothing found";
    std::string text = warnings > 0 ? counted(warnings, "warning") : "";
    if (notes > 0) text += (text.empty() ? "" : " and ") + counted(notes, "note");
    return text;
}

/// The rules that are broken, the most frequent first: "point-spacing 17, chord-error 1".
std::string rules_text(const LintReport& r) {
    std::vector<std::pair<std::size_t, std::string_view>> counts;
    for (const LintRule& rule : r.rules) {
        if (const std::size_t count = r.count(rule.name); count > 0) counts.emplace_back(count, rule.name);
    }
    std::ranges::stable_sort(counts, std::greater{}, &std::pair<std::size_t, std::string_view>::first);
    std::string text;
    for (const auto& [count, name] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
    return text;
}

std::string summary_text(const ReportedLint& l) {
    const LintReport& r = l.report;
    if (r.not_finishing > 0.5)
        return fmt::format(
            "no finishing passes to judge: {:.0f} % of the cutting is pockets, drilling or single contours\n",
            100 * r.not_finishing);
    std::string text = fmt::format("{} on {}", counts_text(r), counted(r.passes, "pass", "passes"));
    if (r.step_over > 0) text += fmt::format(", {:.3g} mm apart", r.step_over);
    text += fmt::format("; lines usually {:.3g} mm long, chord error {:.2f} µm (95th percentile)", r.spacing,
                        r.chord_error * um_per_mm);
    text += r.tolerance > 0 ? fmt::format(", tolerance of the controller {:.1f} µm\n", r.tolerance * um_per_mm)
                            : ", tolerance of the controller not known\n";
    if (r.step_over <= 0) text += "no adjacent passes: nothing to compare\n";
    if (!r.findings.empty()) text += rules_text(r) + "\n";
    return text;
}

/// One line per program, those with most warnings first.
std::string table_text(std::span<const ReportedLint> programs) {
    std::vector<const ReportedLint*> order;
    for (const ReportedLint& l : programs) order.push_back(&l);
    const auto warnings_of = [](const ReportedLint* l) { return l->report.warnings(); };
    std::ranges::stable_sort(order, std::greater{}, warnings_of);
    const auto bad = std::ranges::count_if(order, [&](const ReportedLint* l) { return warnings_of(l) > 0; });
    std::string text = fmt::format("{}: {} with warnings\n\n warnings  notes  passes  program\n",
                                   counted(std::ssize(programs), "program"), bad);
    for (const ReportedLint* l : order) {
        const LintReport& r = l->report;
        const std::string_view remark = r.not_finishing > 0.5 ? "  (no finishing passes to judge)"
                                        : r.step_over <= 0    ? "  (no adjacent passes)"
                                                              : "";
        text += fmt::format("{:>9}{:>7}{:>8}  {}{}\n", r.warnings(), notes_of(r), r.passes, l->program, remark);
    }
    return text;
}

Json program_json(const ReportedLint& l) {
    const LintReport& r = l.report;
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
    return Json{{"program", l.program},
                {"findings", std::move(findings)},
                {"summary", std::move(summary)},
                {"diagnostics", list(l.diagnostics)}};
}

/// Indices of the rules with findings, and their SARIF entries.
struct BrokenRules {
    std::vector<const LintRule*> rules;
    Json json = Json::array();

    explicit BrokenRules(std::span<const ReportedLint> programs) {
        for (const ReportedLint& l : programs) {
            for (const LintRule& rule : l.report.rules) {
                if (l.report.count(rule.name) == 0 || std::ranges::find(rules, &rule) != rules.end()) continue;
                rules.push_back(&rule);
                json.push_back({{"id", rule.name}, {"shortDescription", {{"text", rule.description}}}});
            }
        }
    }
    [[nodiscard]] std::ptrdiff_t index_of(const LintRule* rule) const {
        return std::ranges::find(rules, rule) - rules.begin();
    }
};

Json result_json(const std::string& uri, const LintFinding& f, const BrokenRules& broken) {
    Json result{{"ruleId", f.rule->name},
                {"ruleIndex", broken.index_of(f.rule)},
                {"level", name_of(f.severity)},
                {"message", {{"text", fmt::format("{}, {}", message_of(f), place_text(f.place))}}},
                {"locations", Json::array({sarif_location(uri, f.first_line, f.last_line, "")})}};
    add_place(result["properties"], f.place);
    if (f.beside_first > 0) {
        Json beside = sarif_location(uri, f.beside_first, f.beside_last, "the adjacent pass");
        beside["id"] = 1;
        result["relatedLocations"] = Json::array({std::move(beside)});
    }
    return result;
}

}  // namespace

std::string lint_text(std::span<const ReportedLint> programs) {
    const bool several = programs.size() > 1;
    std::string text = several ? table_text(programs) : "";
    for (const ReportedLint& l : programs) {
        if (several && l.report.findings.empty()) continue;
        text += (several ? fmt::format("\n{}: ", l.program) : "") + summary_text(l);
        if (!l.report.findings.empty()) text += "\n";
        for (const LintFinding& f : l.report.findings) text += finding_text(l.program, f);
    }
    return text;
}

std::string lint_json(std::span<const ReportedLint> programs) {
    std::vector<std::string> texts;
    for (const ReportedLint& l : programs) texts.push_back(dump(program_json(l)));
    return list_json("programs", texts);
}

std::string lint_sarif(std::span<const ReportedLint> programs) {
    BrokenRules broken(programs);
    Json results = Json::array();
    for (const ReportedLint& l : programs) {
        const std::string uri = sarif_uri(l.program);
        for (const LintFinding& f : l.report.findings) results.push_back(result_json(uri, f, broken));
    }
    return sarif_text(std::move(broken.json), std::move(results));
}

}  // namespace clsurf::io

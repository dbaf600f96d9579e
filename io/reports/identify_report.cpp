#include "io/reports/identify_report.h"

#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"
#include "io/files/json_value.h"
#include "io/files/toml_table.h"
#include "io/readers/machine_file.h"
#include "io/reports/fidelity_report.h"

namespace clsurf::io {
namespace {

/// "± 0.0012 1/s; BIC falls by 120", as far as it is known.
std::string evidence_of(const IdentifiedParameter& p) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    if (p.standard_error) add(fmt::format("± {:.2g}{}{}", *p.standard_error, p.unit.empty() ? "" : " ", p.unit));
    if (p.reached) add(*p.reached ? "reached" : "a lower bound");
    if (!p.note.empty()) add(p.note);
    return text;
}

/// The content of a machine file, as JSON.
Json machine_json(const Machine& machine) {
    std::ostringstream out;
    const toml::table table = toml::parse(machine_text(machine));
    out << toml::json_formatter(table);
    return Json::parse(out.str());
}

Json parameter_json(const IdentifiedParameter& p) {
    return Json{{"name", p.name},
                {"axis", p.axis},
                {"value", number(p.value)},
                {"unit", p.unit},
                {"standard_error", p.standard_error ? number(*p.standard_error) : Json(nullptr)},
                {"reached", p.reached ? Json(*p.reached) : Json(nullptr)},
                {"note", p.note}};
}

Json run_json(const RunFidelity& run) {
    Json json = fidelity_json(summary_of({&run, 1}, FidelityBasis::test));
    json.erase("basis");
    json["runs"] = Json::array({run.log});
    json["duration_s"] = number(run.duration, 3);
    json["simulated_duration_s"] = number(run.simulated_duration, 3);
    json["compared_share"] = number(run.compared, 4);
    json["defects"] = run.defects_logged;
    json["simulated_defects"] = run.defects_simulated;
    return json;
}

Json runs_json(std::span<const RunFidelity> runs) {
    Json list = Json::array();
    for (const RunFidelity& run : runs) list.push_back(run_json(run));
    return list;
}

Json fit_json(const Identification& result) {
    Json fit{{"runs", result.runs}};
    if (const Json summary = fidelity_json(summary_of(result.fit, FidelityBasis::fit)); !summary.is_null()) {
        for (const auto& [key, value] : summary.items())
            if (key != "runs" && key != "basis") fit[key] = value;
    }
    fit["each"] = runs_json(result.fit);
    fit["cross_validation"] = runs_json(result.cross_validation);
    return fit;
}

Json rules_json(const Identification& result) {
    Json list = Json::array();
    for (const RuleCandidate& c : result.rules)
        list.push_back(Json{{"rule", c.rule},
                            {"value", c.value},
                            {"score", number(c.score, 1)},
                            {"speed_error_mm_min", number(c.speed_error * seconds_per_minute, 2)},
                            {"chosen", c.chosen}});
    return list;
}

std::string rules_text(const Identification& result) {
    if (result.rules.empty()) return {};
    std::string text = fmt::format("\n{:<24} {:<32} {:>12} {:>18}\n", "rule", "value", "score", "speed, mm/min");
    for (const RuleCandidate& c : result.rules)
        text += fmt::format("{:<24} {:<32} {:>12.1f} {:>18.2f}{}\n", c.rule, c.value, c.score,
                            c.speed_error * seconds_per_minute, c.chosen ? "  chosen" : "");
    return text;
}

std::string runs_text(const char* title, std::span<const RunFidelity> runs) {
    if (runs.empty()) return {};
    std::string text = fmt::format("\n{}\n", title);
    const auto share = [](const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : "-"; };
    for (const RunFidelity& run : runs) {
        text += fmt::format(
            "  {}: time {:.3f} s, simulated {:.3f} s ({} %); speed |difference| 50 % {:.1f}, 95 % {:.1f} of {:.0f} mm/min",
            run.log, run.duration, run.simulated_duration, signed_text(run.time_error * 100, 2),
            run.speed_error_p50 * seconds_per_minute, run.speed_error_p95 * seconds_per_minute,
            run.usual_speed * seconds_per_minute);
        if (run.following_error_p95)
            text += fmt::format("; following error 95 % {:.2f} of {:.1f} µm", *run.following_error_p95 * 1000,
                                run.following_error.value_or(0) * 1000);
        text += fmt::format(
            "; defects {} in the log, {} simulated, recall {}, precision {}; {:.1f} % of the path compared\n",
            run.defects_logged, run.defects_simulated, share(run.recall()), share(run.precision()), run.compared * 100);
    }
    return text;
}

/// Keeps track of the section while reading the text of a machine file line by line.
class SectionReader {
public:
    /// The section after this line, named as in parameters.
    const std::string& after(const std::string& line) {
        if (line == "[controller]") section_ = "controller";
        if (line == "[path]") section_ = "path";
        if (line == "[kinematics]") section_.clear();
        if (line == "[[axis]]") section_ = "?";
        if (section_ == "?" && line.starts_with("name = \"")) section_ = line.substr(8, 1);
        return section_;
    }

private:
    std::string section_;
};

/// A line of a machine file with the result as a comment after its value.
std::string annotated(const std::string& line, const std::string& section, const Identification& result) {
    const std::size_t equals = line.find(" = ");
    if (section.empty() || equals == std::string::npos) return line;
    const std::string key = line.substr(0, equals);
    std::string comment;
    if (const IdentifiedParameter* found = result.find(key, section)) {
        comment = evidence_of(*found);
    } else if (const UnidentifiedParameter* missing = result.find_missing(key, section)) {
        comment = "not identified: " + missing->reason;
    }
    if (comment.empty()) return line;
    std::string value = line.substr(0, line.find('#'));
    value.erase(value.find_last_not_of(' ') + 1);
    return fmt::format("{:<36} # {}", value, comment);
}

}  // namespace

std::string identification_text(const Identification& result) {
    std::string text =
        fmt::format("{:<24} {:<10} {:>14} {:<9} {:>12}  {}\n", "value", "of", "", "", "± std. error", "evidence");
    for (const IdentifiedParameter& p : result.parameters) {
        const std::string error = p.standard_error ? fmt::format("{:.2g}", *p.standard_error) : "";
        std::string note = p.reached ? (*p.reached ? "reached" : "lower bound") : "";
        if (!p.note.empty()) note += (note.empty() ? "" : "; ") + p.note;
        text += fmt::format("{:<24} {:<10} {:>14} {:<9} {:>12}  {}\n", p.name, p.axis, p.value, p.unit, error, note);
        text.erase(text.find_last_not_of(" \n") + 1);
        text += '\n';
    }
    text += rules_text(result);
    text += runs_text("fitted runs", result.fit);
    text += runs_text("cross-validation: each run left out of the fit", result.cross_validation);
    text += runs_text("test runs, not used for the fit", result.tests);
    if (result.unidentified.empty()) return text;
    text += "\nnot identified\n";
    // One line per reason and axis.
    std::vector<std::pair<std::string, std::string>> lines;
    for (const UnidentifiedParameter& u : result.unidentified) {
        const std::string reason = fmt::format("{}: {}", u.axis, u.reason);
        if (lines.empty() || lines.back().first != reason) lines.emplace_back(reason, "");
        lines.back().second += (lines.back().second.empty() ? "" : ", ") + u.name;
    }
    for (const auto& [reason, names] : lines) text += fmt::format("  {} ({})\n", reason, names);
    return text;
}

std::string identification_json(const Identification& result, const Diagnostics& diagnostics) {
    Json parameters = Json::array(), missing = Json::array();
    for (const IdentifiedParameter& p : result.parameters) parameters.push_back(parameter_json(p));
    for (const UnidentifiedParameter& u : result.unidentified)
        missing.push_back(Json{{"name", u.name}, {"axis", u.axis}, {"reason", u.reason}});
    return dump(Json{{"machine", machine_json(result.machine)},
                     {"parameters", std::move(parameters)},
                     {"rules", rules_json(result)},
                     {"fit", fit_json(result)},
                     {"tests", runs_json(result.tests)},
                     {"unidentified", std::move(missing)},
                     {"diagnostics", list(diagnostics)}});
}

std::string identified_machine_text(const Identification& result) {
    std::string text = "# Identified by clsurf from:\n";
    for (const std::string& run : result.runs) text += "#   " + run + "\n";
    text += "# After a value: its standard error and the evidence. Values without them are defaults or were given.\n";
    SectionReader sections;
    std::istringstream lines(machine_text(result.machine));
    for (std::string line; std::getline(lines, line);) text += annotated(line, sections.after(line), result) + "\n";
    return text;
}

}  // namespace clsurf::io

#include "io/reports/identify_report.h"

#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "io/files/json_value.h"
#include "io/files/toml_table.h"
#include "io/readers/machine_file.h"

namespace clsurf::io {
namespace {

/// "± 0.0012 1/s; BIC falls by 120", as far as it is known.
std::string evidence_of(const IdentifiedParameter& p) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    if (p.standard_error) add(fmt::format("± {:.2g}{}{}", *p.standard_error, p.unit.empty() ? "" : " ", p.unit));
    if (p.reached) add(*p.reached ? "reached" : "a lower bound, never reached");
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

/// Follows the sections of a machine file's text.
class SectionReader {
public:
    /// The section's name as parameters have it, after this line.
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

/// A line of a machine file with what was found behind its value.
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
    if (result.unidentified.empty()) return text;
    text += "\nnot identified\n";
    // One line a reason and axis.
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
                     {"fit", Json{{"runs", result.runs}}},
                     {"unidentified", std::move(missing)},
                     {"diagnostics", list(diagnostics)}});
}

std::string identified_machine_text(const Identification& result) {
    std::string text = "# Identified by clsurf from:\n";
    for (const std::string& run : result.runs) text += "#   " + run + "\n";
    text +=
        "# Behind a value: its standard error and the evidence. Values without one are defaults, or as they were given.\n";
    SectionReader sections;
    std::istringstream lines(machine_text(result.machine));
    for (std::string line; std::getline(lines, line);) text += annotated(line, sections.after(line), result) + "\n";
    return text;
}

}  // namespace clsurf::io

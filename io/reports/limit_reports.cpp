#include "io/reports/limit_reports.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "io/reports/sarif.h"

namespace clsurf::io {
namespace {

constexpr std::size_t most_rows = 20;     ///< number of rows in the text; JSON and CSV have all
constexpr std::size_t widest_block = 40;  ///< characters of a block in the text
constexpr double grave = 1.5;             ///< factor from which a finding is an error in SARIF

double shown(const StatedLimit& limit, double value) { return value * unit_of(limit).per_inside; }

std::string text_of_block(const Program& program, LineNumber line) {
    std::string text(program.main().line(line));
    const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

/// "0.0202": five significant digits, for values from micrometres to jerks.
std::string digits(double value) {
    return std::abs(value) >= 1e4 ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

std::string finding_sentence(const LimitFinding& f) {
    return fmt::format("The {} is {:.3f} ± {:.3f} times its limit for {:.4g} ms: {} of {} {}", words_of(f.limit),
                       f.factor, f.uncertainty, 1e3 * f.duration, digits(shown(f.limit, f.value)),
                       digits(shown(f.limit, f.limit.value)), unit_of(f.limit).name);
}

}  // namespace

Json limits_json(const LimitReport& report, const Program& program) {
    Json all = Json::array();
    for (const LimitFinding& f : report.findings) {
        all.push_back({{"quantity", name_of(f.limit.quantity)},
                       {"axis", axis_name(f.limit)},
                       {"factor", number(f.factor, 4)},
                       {"uncertainty", number(f.uncertainty, 4)},
                       {"value", number(shown(f.limit, f.value), 4)},
                       {"limit", number(shown(f.limit, f.limit.value), 4)},
                       {"unit", unit_of(f.limit).name},
                       {"line", f.line},
                       {"text", text_of_block(program, f.line)},
                       {"time_s", number(f.time, 6)},
                       {"duration_s", number(f.duration, 6)},
                       {"point", f.point},
                       {"tip_mm", vector(f.tip)}});
    }
    return all;
}

Json judged_limits_json(const LimitReport& report) {
    Json all = Json::array();
    for (const JudgedLimit& judged : report.judged) {
        all.push_back({{"quantity", name_of(judged.limit.quantity)},
                       {"axis", axis_name(judged.limit)},
                       {"limit", number(shown(judged.limit, judged.limit.value), 4)},
                       {"unit", unit_of(judged.limit).name},
                       {"factor", number(judged.factor, 4)},
                       {"uncertainty", number(judged.uncertainty, 4)}});
    }
    return all;
}

/// The largest share of each limit that is used, with its uncertainty: one row per quantity.
std::string shares_text(const LimitReport& report) {
    std::vector<std::string_view> names;
    for (const JudgedLimit& judged : report.judged) {
        const std::string_view name = name_of(judged.limit.quantity);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    std::string text = "Largest share of each limit used:\n";
    for (const std::string_view name : names) {
        std::string row = fmt::format("  {:<24}", name);
        for (const JudgedLimit& judged : report.judged) {
            if (name_of(judged.limit.quantity) == name)
                row += fmt::format("  {} {:.3f} ± {:.3f}", axis_name(judged.limit), judged.factor, judged.uncertainty);
        }
        text += row + '\n';
    }
    return text;
}

std::string limits_text(const LimitReport& report, const Program& program) {
    // A machine file with kinematics alone has no limits to judge.
    if (report.judged.empty()) return report.diagnostics.empty() ? "" : "limits: none could be judged\n\n";
    std::string text;
    if (report.findings.empty()) {
        text = fmt::format("The commanded motion keeps all {} limits that are stated for it.\n", report.judged.size());
    } else {
        const LimitFinding& worst = report.findings.front();
        text = fmt::format("LIMITS EXCEEDED in {} {}. Worst: {}, line {}.\n\n", report.findings.size(),
                           report.findings.size() == 1 ? "place" : "places", finding_sentence(worst), worst.line);
        text += fmt::format("{:>15} {:<27} {:>11} {:>11} {:<8} {:>9} {:>7}  {}\n", "times limit", "quantity, axis",
                            "value", "limit", "", "time [s]", "[ms]", "line");
        for (std::size_t i = 0; i < std::min(most_rows, report.findings.size()); ++i) {
            const LimitFinding& f = report.findings[i];
            text += fmt::format("{:>7.3f} ± {:.3f} {:<27} {:>11} {:>11} {:<8} {:>9.3f} {:>7.4g}  {} {:.{}}\n", f.factor,
                                f.uncertainty, fmt::format("{} {}", name_of(f.limit.quantity), axis_name(f.limit)),
                                digits(shown(f.limit, f.value)), digits(shown(f.limit, f.limit.value)),
                                unit_of(f.limit).name, f.time, 1e3 * f.duration, f.line, text_of_block(program, f.line),
                                widest_block);
        }
        if (report.findings.size() > most_rows)
            text += fmt::format("… and {} more: --format json or csv has all\n", report.findings.size() - most_rows);
    }
    return text + shares_text(report) + "\n";
}

std::string_view limit_column_titles() { return "axis,factor,uncertainty,value,limit,unit,time [s],duration [s]"; }

std::string limits_csv(const LimitReport& report, std::size_t id) {
    std::string text;
    for (const LimitFinding& f : report.findings) {
        text += fmt::format(
            "{},,limit,,{},{},{},{},{:.4f},{:.4f},{:.4f},,,,,,,,,{},,tool tip,,,,{},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.6f},{:.6f},,\n",
            id++, f.line, f.line, f.points.first, f.points.last, f.tip.x(), f.tip.y(), f.tip.z(),
            name_of(f.limit.quantity), axis_name(f.limit), f.factor, f.uncertainty, shown(f.limit, f.value),
            shown(f.limit, f.limit.value), unit_of(f.limit).name, f.time, f.duration);
    }
    return text;
}

void add_limits_sarif(const LimitReport& report, const Program& program, const std::string& log, Json& rules,
                      Json& results) {
    const std::string uri = sarif_uri(program.main().name());
    std::map<std::string, std::size_t> index_of_rule;
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        const LimitFinding& f = report.findings[i];
        const std::string rule = fmt::format("limit_{}", name_of(f.limit.quantity));
        const auto [at, is_new] = index_of_rule.try_emplace(rule, rules.size());
        if (is_new) {
            const std::string help =
                "Commanded positions change faster, or leave the path farther, than the stated limit allows. Compare the limits of the machine file with those of the controller, then lower the feed in this line or its path tolerance.";
            rules.push_back(
                {{"id", rule},
                 {"shortDescription", {{"text", fmt::format("Exceeds a limit: {}.", name_of(f.limit.quantity))}}},
                 {"help", {{"text", help}, {"markdown", help}}}});
        }
        const std::string print = fmt::format("{}/{}/{}", rule, axis_name(f.limit), f.line);
        const int number_of = ++seen[print];
        results.push_back({{"ruleId", rule},
                           {"ruleIndex", at->second},
                           {"level", f.factor >= grave ? "error" : "warning"},
                           {"message", {{"text", finding_sentence(f) + "."}}},
                           {"locations", Json::array({sarif_location(uri, f.line, f.line, "")})},
                           {"rank", number(100.0 * static_cast<double>(report.findings.size() - i) /
                                               static_cast<double>(report.findings.size()),
                                           1)},
                           {"partialFingerprints", {{"clsurfLimit/v1", fmt::format("{}/{}", print, number_of)}}},
                           {"properties",
                            {{"quantity", name_of(f.limit.quantity)},
                             {"axis", axis_name(f.limit)},
                             {"factor", number(f.factor, 4)},
                             {"uncertainty", number(f.uncertainty, 4)},
                             {"time_s", number(f.time, 6)},
                             {"point", f.point},
                             {"log", log}}}});
    }
}

}  // namespace clsurf::io

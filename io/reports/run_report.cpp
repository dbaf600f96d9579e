#include "io/reports/run_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "io/files/json_value.h"
#include "io/reports/quality_words.h"
#include "io/reports/roughness_json.h"
#include "io/reports/roughness_words.h"

namespace clsurf::io {
namespace {

constexpr int shown_of_quantity = 3;  ///< sections of a run in the text

const RunQuantityInfo& info_of(RunQuantity q) { return run_quantity_table()[index_of(q)]; }

/// Significant decimals of a quantity in shown units.
int decimals_of(RunQuantity q) { return q == RunQuantity::following_error || q == RunQuantity::height ? 3 : 1; }

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

Json quantity_json(const RunQuantitySummary& s) {
    const RunQuantityInfo& info = info_of(s.quantity);
    const auto shown = [&](double value) { return number(value * info.unit.per_inside, decimals_of(s.quantity)); };
    Json json{{"name", info.name},
              {"unit", info.unit.name},
              {"threshold", shown(s.threshold)},
              {"compared_mm", number(s.arc_length, 3)},
              {"mean", shown(s.mean)},
              {"rms", shown(s.rms)},
              {"p95", shown(s.p95)},
              {"lowest", shown(s.lowest)},
              {"highest", shown(s.highest)},
              {"begin", shown(s.begin)},
              {"end", shown(s.end)},
              {"over_percent", number(100 * s.over, 2)},
              {"stretches", s.sections}};
    if (s.quantity == RunQuantity::speed) json["most_percent"] = number(100 * s.relative_most, 1);
    return json;
}

Json section_json(const RunDifferenceSection& d, std::size_t id) {
    const RunQuantityInfo& info = info_of(d.quantity);
    const auto shown = [&](double value) { return number(value * info.unit.per_inside, decimals_of(d.quantity)); };
    Json json{{"id", id},
              {"quantity", info.name},
              {"unit", info.unit.name},
              {"peak", shown(d.peak)},
              {"mean", shown(d.mean)},
              {"lines", Json::array({d.first_line, d.last_line})},
              {"points", Json::array({d.points.first, d.points.last})},
              {"points_of_run", Json::array({d.points_of_b.first, d.points_of_b.last})},
              {"point", d.point},
              {"length_mm", number(d.length, 3)},
              {"time_s", number(d.time, 6)},
              {"score", number(d.score, 2)}};
    add_place(json, d.place);
    if (d.quantity == RunQuantity::speed) {
        json["peak_percent"] = number(100 * d.relative_peak, 1);
        json["mean_percent"] = number(100 * d.relative_mean, 1);
    }
    return json;
}

Json run_json(const ReportedRun& run) {
    const RunReport& r = run.report;
    Json quantities = Json::array();
    for (const RunQuantitySummary& s : r.quantities) quantities.push_back(quantity_json(s));
    Json differences = Json::array();
    for (std::size_t i = 0; i < r.sections.size(); ++i) differences.push_back(section_json(r.sections[i], i + 1));
    Json budget = Json::array();
    for (const BudgetLine& line : run.budget) {
        budget.push_back({{"name", line.name},
                          {"limit", number(line.limit, 4)},
                          {"measured", number(line.measured, 4)},
                          {"held", line.held}});
    }
    const auto roughness = [&](PartRoughness RoughnessChange::*side) {
        return roughness_json(run.roughness ? std::optional((*run.roughness).*side) : std::nullopt);
    };
    return Json{{"name", run.name},
                {"aligned_mm", number(r.aligned, 3)},
                {"aligned_percent", number(percent(r.aligned, r.arc_length), 2)},
                {"time_s", number(r.time_of_b, 6)},
                {"reference_time_s", number(r.time, 6)},
                {"time_difference_s", number(r.time_of_b - r.time, 6)},
                {"roughness", roughness(&RoughnessChange::after)},
                {"reference_roughness", roughness(&RoughnessChange::before)},
                {"quantities", std::move(quantities)},
                {"differences", std::move(differences)},
                {"budget", std::move(budget)},
                {"within_budget", all_held(run.budget)}};
}

std::string lines_of(const RunDifferenceSection& d) {
    if (d.first_line == 0 && d.last_line == 0) return "-";
    return d.first_line == d.last_line ? fmt::format("{}", d.first_line)
                                       : fmt::format("{}-{}", d.first_line, d.last_line);
}

/// A table of the roughness of both; empty: not known.
std::string roughness_text(const ReportedRun& run) {
    if (!run.roughness) return {};
    std::string rows;
    write_roughness_change(*run.roughness, [&](std::string_view name, double reference, double other) {
        const std::string change = reference > 0 ? signed_text(100 * (other / reference - 1), 1) + " %" : "";
        rows += fmt::format("{:<31} {:>10.2f} {:>10.2f} {:>10}\n", name, reference, other, change);
    });
    if (rows.empty()) return {};
    return fmt::format("\n{:<31} {:>10} {:>10} {:>10}\n", "as-machined surface", "reference", "run", "change") + rows;
}

std::string run_text(const ReportedRun& run, const std::string& reference) {
    const RunReport& r = run.report;
    std::string text = fmt::format("{} against {}: {:.1f} % of {:.1f} mm aligned, {:.3f} s and {:.3f} s ({} s)\n",
                                   run.name, reference, percent(r.aligned, r.arc_length), r.arc_length, r.time_of_b,
                                   r.time, signed_text(r.time_of_b - r.time, 3));
    text += fmt::format("{:<21} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8} {:>7}\n", "difference", "mean", "95 %",
                        "lowest", "highest", "begin", "end", "over %", "places");
    for (const RunQuantitySummary& s : r.quantities) {
        const RunQuantityInfo& info = info_of(s.quantity);
        const double u = info.unit.per_inside;
        text += fmt::format("{:<21}", fmt::format("{} [{}]", info.name, info.unit.name));
        for (const double value : {s.mean, s.p95, s.lowest, s.highest, s.begin, s.end})
            text += fmt::format(" {:>10}", fixed_text(value * u, 2));
        text += fmt::format(" {:>8.1f} {:>7}\n", 100 * s.over, s.sections);
    }
    text += roughness_text(run);
    if (!r.sections.empty())
        text += fmt::format("\n{:>3} {:<13} {:>16} {:>10} {:>8} {:>8} {:<28} {}\n", "no", "quantity", "peak", "mean",
                            "mm", "s", fmt::format("{} X Y Z [mm]", place_word(r.sections.front().place)), "lines");
    // The worst sections are often all of one quantity; the worst of the other quantities must also be shown.
    std::array<int, run_quantities> shown{};
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < r.sections.size(); ++i) {
        const RunDifferenceSection& d = r.sections[i];
        if (++shown[index_of(d.quantity)] > shown_of_quantity) {
            ++left_out;
            continue;
        }
        const RunQuantityInfo& info = info_of(d.quantity);
        const double u = info.unit.per_inside;
        const bool relative = d.quantity == RunQuantity::speed;
        text += fmt::format("{:>3} {:<13} {:>16} {:>10} {:>8.2f} {:>8} {:<28} {}\n", i + 1, info.name,
                            relative ? signed_text(100 * d.relative_peak, 1) + " %"
                                     : fmt::format("{} {}", signed_text(d.peak * u, 2), info.unit.name),
                            relative ? signed_text(100 * d.relative_mean, 1) + " %" : signed_text(d.mean * u, 2),
                            d.length, signed_text(d.time, 3), coordinates_text(d.place.position()), lines_of(d));
    }
    if (left_out > 0) text += fmt::format("and {} more: --json lists them\n", left_out);
    for (const BudgetLine& line : run.budget) {
        text += fmt::format("budget {:<34} {:>10.4g} of {:<10.4g} {}\n", line.name, line.measured, line.limit,
                            line.held ? "kept" : "NOT KEPT");
    }
    return text;
}

}  // namespace

bool ReportedRuns::within_budget() const {
    return std::all_of(runs.begin(), runs.end(), [](const ReportedRun& run) { return all_held(run.budget); });
}

std::string runs_json(const ReportedRuns& runs) {
    Json list_of_runs = Json::array();
    for (const ReportedRun& run : runs.runs) list_of_runs.push_back(run_json(run));
    Json json{{"reference", runs.reference}, {"runs", std::move(list_of_runs)}};
    if (!runs.departures.empty()) {
        Json departures = Json::array();
        for (std::size_t i = 0; i < runs.departures.size(); ++i) {
            const RunDeparture& d = runs.departures[i];
            Json rms;
            for (const RunQuantityInfo& info : run_quantity_table()) {
                rms[std::string(info.name) + "_" + std::string(info.json_suffix)] =
                    number(d.rms[index_of(info.quantity)] * info.unit.per_inside, decimals_of(info.quantity));
            }
            departures.push_back({{"name", runs.name_of(i)},
                                  {"score", number(d.score, 2)},
                                  {"quantity", info_of(d.quantity).name},
                                  {"rms", std::move(rms)}});
        }
        json["departures"] = std::move(departures);
        json["drifted"] = runs.drifted ? Json(runs.name_of(*runs.drifted)) : Json(nullptr);
    }
    json["within_budget"] = runs.within_budget();
    json["diagnostics"] = list(*runs.diagnostics);
    return dump(json);
}

std::string runs_text(const ReportedRuns& runs) {
    std::string text;
    for (const ReportedRun& run : runs.runs) text += (text.empty() ? "" : "\n") + run_text(run, runs.reference);
    if (runs.departures.empty()) return text;
    text += "\ndeviation from the median run, rms:\n";
    for (std::size_t i = 0; i < runs.departures.size(); ++i) {
        const RunDeparture& d = runs.departures[i];
        text += fmt::format("{:<30}", runs.name_of(i));
        for (const RunQuantityInfo& info : run_quantity_table()) {
            const double rms = d.rms[index_of(info.quantity)] * info.unit.per_inside;
            if (rms == rms) text += fmt::format("  {} {:.2f} {}", info.name, rms, info.unit.name);
        }
        text += "\n";
    }
    text += runs.drifted ? fmt::format("{} drifted: {}\n", runs.name_of(*runs.drifted),
                                       info_of(runs.departures[*runs.drifted].quantity).name)
                         : std::string("no run drifted\n");
    return text;
}

}  // namespace clsurf::io

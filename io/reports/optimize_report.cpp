#include "io/reports/optimize_report.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/counted.h"
#include "core/decimal_text.h"
#include "core/units.h"
#include "io/files/json_value.h"
#include "io/reports/defect_json.h"
#include "io/reports/fidelity_report.h"
#include "io/reports/roughness_json.h"
#include "io/reports/roughness_words.h"

namespace clsurf::io {
namespace {

/// The number of defects by the quantity that shows them best.
std::array<std::size_t, quantities> by_quantity(const JudgedRun& run) {
    std::array<std::size_t, quantities> counts{};
    for (const Defect& defect : run.report.defects) ++counts[index_of(defect.quantity)];
    return counts;
}

std::string program_of(const ControllerRun& run) {
    if (!run.round.empty()) return run.round;
    return run.candidate == 0 ? "the program" : fmt::format("candidate {}", run.candidate);
}

/// The results of runs on controllers, next to the predicted ones.
std::string controller_text(const std::vector<ControllerRun>& runs) {
    std::string text;
    const auto words = [](const RunMeasures& m) {
        return fmt::format("{:.3f} s, speed mismatch {:.1f} mm/min, {:.0f} defect{}", m.duration,
                           m.mismatch * seconds_per_minute, m.defects, m.defects == 1 ? "" : "s");
    };
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const ControllerRun& run = runs[k];
        text += fmt::format("run {}, {}: ", k + 1, program_of(run));
        text += run.measured ? words(*run.measured) : "failed: " + run.reason;
        if (run.measured && run.promised) text += fmt::format("; promised {}", words(*run.promised));
        if (run.measured && run.candidate > 0)
            text += run.accepted ? "; accepted" : fmt::format("; refused: {}", run.reason);
        if (!run.round.empty() && !run.accepted) text += fmt::format("; no better than the program: {}", run.reason);
        text += "\n";
    }
    return text;
}

Json measures_json(const std::optional<RunMeasures>& m) {
    if (!m) return nullptr;
    return Json{{"time_s", number(m->duration, 6)},
                {"mismatch", number(m->mismatch * seconds_per_minute, 2)},
                {"defects", number(m->defects, 2)}};
}

Json controller_json(const std::vector<ControllerRun>& runs) {
    Json list = Json::array();
    for (const ControllerRun& run : runs)
        list.push_back(Json{{"program", program_of(run)},
                            {"measured", measures_json(run.measured)},
                            {"promised", measures_json(run.promised)},
                            {"accepted", run.accepted},
                            {"reason", run.reason.empty() ? Json(nullptr) : Json(run.reason)}});
    return list;
}

std::string ensemble_text(const EnsembleResult& ensemble) {
    if (ensemble.runs.empty()) return {};
    const auto words = [](const char* name, const EnsembleRun& run) {
        return fmt::format(
            "  {}: time {:.3f} to {:.3f} s, speed mismatch{} {:.1f} to {:.1f} mm/min, defects {:.3g} to {:.3g}, gain {:.1f} %\n",
            name, run.before.duration, run.after.duration, defects_alone_count(run.before) ? " of defects" : "",
            objective_mismatch(run.before, run.before) * seconds_per_minute,
            objective_mismatch(run.before, run.after) * seconds_per_minute, run.before.defects, run.after.defects,
            100 * run.gain);
    };
    return fmt::format("on {} other machines within the uncertainty of the machine file\n", ensemble.runs.size()) +
           words("mean", ensemble.mean()) + words("worst", ensemble.worst());
}

Json ensemble_json(const EnsembleResult& ensemble) {
    if (ensemble.runs.empty()) return nullptr;
    const auto object = [](const EnsembleRun& run) {
        return Json{{"time_before_s", number(run.before.duration, 6)},
                    {"time_after_s", number(run.after.duration, 6)},
                    {"mismatch_before", number(run.before.mismatch * seconds_per_minute, 2)},
                    {"mismatch_after", number(run.after.mismatch * seconds_per_minute, 2)},
                    {"defects_before", number(run.before.defects, 2)},
                    {"defects_after", number(run.after.defects, 2)},
                    {"gain_percent", number(100 * run.gain, 2)}};
    };
    return Json{
        {"machines", ensemble.runs.size()}, {"worst", object(ensemble.worst())}, {"mean", object(ensemble.mean())}};
}

std::optional<RoughnessChange> roughness_change_of(const Optimized& r) {
    if (!r.roughness_before || !r.roughness_after) return std::nullopt;
    return RoughnessChange{*r.roughness_before, *r.roughness_after};
}

}  // namespace

std::string optimize_text(const Optimized& r) {
    std::string text;
    const auto row = [&](std::string_view name, double before, double after, int digits) {
        const double change = before > 0 ? 100 * (after / before - 1) : 0;
        text += fmt::format("{:<31} {:>11.{}f} {:>12.{}f} {:>8} %\n", name, before, digits, after, digits,
                            signed_text(change, 1));
    };
    if (r.measured) {
        text += fmt::format(
            "log: {:.3f} s, speed mismatch {:.1f} mm/min (p95), {} defect{}; {} motions need repair, the others stay as they are\n",
            r.measured->duration, r.measured->mismatch * seconds_per_minute, r.measured->defects,
            r.measured->defects == 1 ? "" : "s", r.measured->motions_in_need);
    }
    text += "machine: " + r.machine + "\n";
    text += controller_text(r.controller_runs);
    text += fmt::format("{:<31} {:>11} {:>12} {:>10}\n", r.on_controller ? "on the controller" : "simulated", "before",
                        "after", "change");
    row("time [s]", r.before.duration, r.after.duration, 3);
    row("speed mismatch p95 [mm/min]", r.before.mismatch * seconds_per_minute, r.after.mismatch * seconds_per_minute,
        1);
    row("speed mismatch p99.9 [mm/min]", r.before.greatest_mismatch * seconds_per_minute,
        r.after.greatest_mismatch * seconds_per_minute, 1);
    row("defects", static_cast<double>(r.evaluation.defects_before), static_cast<double>(r.evaluation.defects_after),
        0);
    const auto before = by_quantity(r.before), after = by_quantity(r.after);
    for (std::size_t k = 0; k < quantities; ++k) {
        if (before[k] + after[k] > 0)
            row(fmt::format("  of {}", name_of(static_cast<Quantity>(k))), static_cast<double>(before[k]),
                static_cast<double>(after[k]), 0);
    }
    if (const std::optional<RoughnessChange> roughness = roughness_change_of(r))
        write_roughness_change(*roughness,
                               [&](std::string_view name, double was, double is) { row(name, was, is, 2); });
    row("lines", r.evaluation.lines_before, r.evaluation.lines_after, 0);
    const std::string splines =
        r.evaluation.splines > 0 ? fmt::format(" ({} as splines)", r.evaluation.splines) : std::string();
    text += fmt::format("{}{}, {} changed; off the programmed path by at most {:.4f} mm\n",
                        counted(r.evaluation.intervals, "section"), splines,
                        counted(r.evaluation.changed_lines, "line"), r.evaluation.deviation.greatest);
    if (r.five_axes)
        text += fmt::format("tool axis deviates from the programmed one by at most {:.4f} deg\n",
                            r.evaluation.deviation.turned * deg_per_rad);
    text += ensemble_text(r.ensemble) + fidelity_line(r.fidelity);
    text += r.evaluation.accepted ? "accepted\n" : fmt::format("refused: {}\n", r.evaluation.reason);
    return text;
}

namespace {

Json measured_json(const std::optional<Measured>& measured) {
    if (!measured) return nullptr;
    return Json{{"points", measured->points},
                {"time_s", number(measured->duration, 6)},
                {"mismatch", number(measured->mismatch * seconds_per_minute, 2)},
                {"defects", measured->defects},
                {"motions_in_need", measured->motions_in_need}};
}

}  // namespace

std::string optimize_json(const Optimized& r, const Diagnostics& diagnostics) {
    Json json{{"accepted", r.evaluation.accepted},
              {"reason", r.evaluation.accepted ? Json(nullptr) : Json(r.evaluation.reason)},
              {"deviation_mm", number(r.evaluation.deviation.greatest, 6)},
              {"time_before_s", number(r.before.duration, 6)},
              {"time_after_s", number(r.after.duration, 6)},
              {"mismatch_before", number(r.before.mismatch * seconds_per_minute, 2)},
              {"mismatch_after", number(r.after.mismatch * seconds_per_minute, 2)},
              {"defects_before", r.evaluation.defects_before},
              {"defects_after", r.evaluation.defects_after},
              {"roughness_before", roughness_json(r.roughness_before)},
              {"roughness_after", roughness_json(r.roughness_after)},
              {"intervals", r.evaluation.intervals},
              {"splines", r.evaluation.splines},
              {"lines_before", r.evaluation.lines_before},
              {"lines_after", r.evaluation.lines_after},
              {"lines_changed", r.evaluation.changed_lines},
              {"ensemble", ensemble_json(r.ensemble)},
              {"fidelity", fidelity_json(r.fidelity)},
              {"machine", r.machine},
              {"proof", r.on_controller ? "controller" : "simulation"},
              {"controller_runs", controller_json(r.controller_runs)},
              {"log", measured_json(r.measured)},
              {"diagnostics", list(diagnostics)}};
    const auto before = by_quantity(r.before), after = by_quantity(r.after);
    for (std::size_t k = 0; k < quantities; ++k)
        json["defects_by_quantity"][name_of(static_cast<Quantity>(k))] = Json::array({before[k], after[k]});
    if (r.evaluation.accepted) json["defects_left"] = list_defects(r.after.report.defects, 0);
    if (r.five_axes) json["tool_axis_deviation_deg"] = number(r.evaluation.deviation.turned * deg_per_rad, 5);
    return dump(json);
}

}  // namespace clsurf::io

#include "io/reports/optimize_report.h"

#include <array>

#include <fmt/format.h>

#include "core/units.h"
#include "io/files/json_value.h"
#include "io/reports/defect_json.h"

namespace clsurf::io {
namespace {

/// How many of the defects show in each quantity best.
std::array<std::size_t, quantities> by_quantity(const JudgedRun& run) {
    std::array<std::size_t, quantities> counts{};
    for (const Defect& defect : run.report.defects) ++counts[index_of(defect.quantity)];
    return counts;
}

}  // namespace

std::string optimize_text(const Optimized& r) {
    std::string text;
    const auto row = [&](std::string_view name, double before, double after, int digits, const char* unit) {
        const double change = before > 0 ? 100 * (after / before - 1) : 0;
        text += fmt::format("{:<28} {:>12.{}f} {:>12.{}f} {:>+8.1f} % {}\n", name, before, digits, after, digits,
                            change, unit);
    };
    if (r.measured) {
        text += fmt::format(
            "log: {:.3f} s, speed mismatch {:.1f} mm/min (p95), {} defects; {} motions are in need of repair, all others stay\n",
            r.measured->duration, r.measured->mismatch * seconds_per_minute, r.measured->defects,
            r.measured->motions_in_need);
    }
    text += fmt::format("{:<28} {:>12} {:>12} {:>10}\n", "simulated", "before", "after", "change");
    row("time", r.before.duration, r.after.duration, 3, "s");
    row("speed mismatch, p95", r.before.mismatch * seconds_per_minute, r.after.mismatch * seconds_per_minute, 1,
        "mm/min");
    row("speed mismatch, p99.9", r.before.greatest_mismatch * seconds_per_minute,
        r.after.greatest_mismatch * seconds_per_minute, 1, "mm/min");
    row("defects", static_cast<double>(r.evaluation.defects_before), static_cast<double>(r.evaluation.defects_after), 0,
        "");
    const auto before = by_quantity(r.before), after = by_quantity(r.after);
    for (std::size_t k = 0; k < quantities; ++k) {
        if (before[k] + after[k] > 0)
            row(fmt::format("  of {}", name_of(static_cast<Quantity>(k))), static_cast<double>(before[k]),
                static_cast<double>(after[k]), 0, "");
    }
    row("lines", r.evaluation.lines_before, r.evaluation.lines_after, 0, "");
    text += fmt::format("{} stretches, {} lines changed; off the programmed path by at most {:.4f} mm\n",
                        r.evaluation.intervals, r.evaluation.changed_lines, r.evaluation.deviation.greatest);
    if (r.five_axes)
        text += fmt::format("tool axis off the programmed one by at most {:.4f} deg\n",
                            r.evaluation.deviation.turned * deg_per_rad);
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
              {"intervals", r.evaluation.intervals},
              {"lines_before", r.evaluation.lines_before},
              {"lines_after", r.evaluation.lines_after},
              {"lines_changed", r.evaluation.changed_lines},
              {"proof", "simulation"},
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

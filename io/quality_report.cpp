#include "io/quality_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/units.h"
#include "io/defect_json.h"
#include "io/json_value.h"
#include "io/line_ranges.h"
#include "io/quality_words.h"

namespace clsurf::io {
namespace {

double um(double mm) { return mm * um_per_mm; }
double per_minute(double per_second) { return per_second * seconds_per_minute; }

/// The defects, with what the formed surface and the colours say of each.
Json looked_at_defects(const ReportedQuality& q) {
    Json all = list_defects(q.report->defects, q.scallop);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (q.formed != nullptr) all[i]["formed_um"] = number(um(q.formed->marks[i]));
        if (i < q.colour_differences.size()) all[i]["delta_e00"] = number(q.colour_differences[i]);
    }
    return all;
}

void add_roughness(Json& summary, const FormedReport& f) {
    const auto known = [&](double mm) { return f.patches.empty() ? Json(nullptr) : number(um(mm)); };
    summary["ra_um"] = known(f.ra);
    summary["rz_um"] = known(f.rz);
    summary["rz_most_um"] = known(f.patches.empty() ? 0 : f.patches[f.roughest].profile.rz);
    summary["sa_um"] = known(f.sa);
    summary["sq_um"] = known(f.sq);
    summary["sz_um"] = known(f.sz);
    summary["roughness_cutoff_mm"] = number(f.cutoff);
    summary["roughness_patches"] = f.patches.size();
}

Json patches_json(const FormedReport& f) {
    Json all = Json::array();
    for (const RoughPatch& patch : f.patches) {
        all.push_back({{"point", patch.point},
                       {"position_mm", vector(patch.contact)},
                       {"ra_um", number(um(patch.profile.ra))},
                       {"rq_um", number(um(patch.profile.rq))},
                       {"rz_um", number(um(patch.profile.rz))},
                       {"sa_um", number(um(patch.area.sa))},
                       {"sq_um", number(um(patch.area.sq))},
                       {"sz_um", number(um(patch.area.sz))}});
    }
    return all;
}

/// Why there is no verdict, a line each; empty: there is one.
std::string not_judged_text(const QualityReport& r) {
    std::string text;
    for (const std::string& reason : r.judgement.reasons) text += fmt::format("NOT JUDGED: {}\n", reason);
    return text.empty() ? text : text + "\n";
}

}  // namespace

std::string quality_json(const ReportedQuality& q) {
    const QualityReport& r = *q.report;
    Json budget = Json::array();
    for (const BudgetLine& line : q.budget) {
        budget.push_back({{"name", line.name},
                          {"limit", number(line.limit)},
                          {"measured", number(line.measured)},
                          {"held", line.held}});
    }
    const auto quantity = [&](const std::array<float, quantities>& values, Quantity which) {
        return static_cast<double>(values[index_of(which)]);
    };
    Json thresholds{{"speed_percent", number(100 * quantity(r.thresholds.of, Quantity::speed))},
                    {"acceleration_mm_s2", number(quantity(r.thresholds.of, Quantity::acceleration))},
                    {"lag_um", r.has_lag ? number(um(quantity(r.thresholds.of, Quantity::lag))) : Json(nullptr)},
                    {"relief_um", number(um(quantity(r.thresholds.of, Quantity::relief)))}};
    Json summary{{"judged", r.judgement.judged()},
                 {"not_judged_reasons", r.judgement.reasons},
                 {"points", r.points},
                 {"passes", r.passes},
                 {"defects", r.defects.size()},
                 {"expected", r.expected.size()},
                 {"worst_severity", r.worst_severity()},
                 {"scallop_um", number(um(q.scallop))},
                 {"step_over_mm", number(r.step_over)},
                 {"coverage_percent", number(100 * r.coverage())},
                 {"measured_positions", r.has_lag},
                 {"speed_mismatch_p99_percent", number(100 * quantity(r.thresholds.p99, Quantity::speed))},
                 {"acceleration_mismatch_p99_mm_s2", number(quantity(r.thresholds.p99, Quantity::acceleration))},
                 {"thresholds", std::move(thresholds)},
                 {"filter", r.note},
                 {"tool", to_text(q.tool)},
                 {"budget", std::move(budget)},
                 {"within_budget", r.judgement.judged() && all_held(q.budget)}};
    if (q.formed != nullptr) add_roughness(summary, *q.formed);
    Json json{{"defects", looked_at_defects(q)},
              {"expected", list_defects(q.report->expected, q.scallop)},
              {"summary", std::move(summary)}};
    if (q.formed != nullptr) json["roughness"] = patches_json(*q.formed);
    json["diagnostics"] = list(*q.diagnostics);
    return dump(json);
}

std::string quality_csv(const ReportedQuality& q) {
    std::string text =
        "id,severity,cause,pass,first_line,last_line,first_point,last_point,x [mm],y [mm],z [mm],depth [µm],shape,"
        "speed jump [mm/min],acceleration jump [mm/s²],length [mm],area [mm²],score\n";
    for (std::size_t i = 0; i < q.report->defects.size(); ++i) {
        const Defect& d = q.report->defects[i];
        for (const DefectRun& run : d.runs) {
            text += fmt::format(
                "{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.3f},{},{:.1f},{:.1f},{:.3f},{:.4f},{:.2f}\n", i + 1,
                d.severity, name_of(d.cause), run.pass, run.first_line, run.last_line, run.points.first,
                run.points.last, d.position.x(), d.position.y(), d.position.z(), um(d.depth), d.pit ? "pit" : "bulge",
                per_minute(d.speed_jump), d.acceleration_jump, d.length, d.area, d.score);
        }
    }
    return text;
}

std::string quality_text(const ReportedQuality& q) {
    const QualityReport& r = *q.report;
    std::string text = not_judged_text(r);
    if (!r.defects.empty()) {
        text += fmt::format("{:>3} {:>3} {:<13} {:>9} {:>10} {:>7}{} {:<28} {}\n", "no", "sev", "cause", "depth µm",
                            "speed %", "mm", q.formed != nullptr ? "  formed µm" : "", "at X Y Z [mm]", "lines");
    }
    for (std::size_t i = 0; i < r.defects.size(); ++i) {
        const Defect& d = r.defects[i];
        constexpr std::size_t most_ranges = 4;
        const std::string lines = line_ranges(d.runs, most_ranges);
        const double percent = 100 * d.speed_mismatch;
        const double formed = q.formed != nullptr ? um(q.formed->marks[i]) : 0;
        const std::string mark =
            q.formed == nullptr ? "" : fmt::format(" {:>10}", formed == formed ? fmt::format("{:.1f}", formed) : "-");
        text += fmt::format("{:>3} {:>3} {:<13} {:>8} {:>9} {:>7}{} {:<28} {}\n", i + 1, d.severity, name_of(d.cause),
                            fmt::format("{:+.1f}", d.pit ? -um(d.depth) : um(d.depth)), fmt::format("{:+.1f}", percent),
                            fmt::format("{:.1f}", d.length), mark,
                            fmt::format("{:.2f} {:.2f} {:.2f}", d.position.x(), d.position.y(), d.position.z()), lines);
    }
    if (r.passes < 2 || r.step_over <= 0) {
        text += "no adjacent passes: nothing to compare\n";
    } else {
        text += fmt::format(
            "{}{} defects on {} passes, {:.3g} mm apart; {:.1f} % of {} cutting points compared with both neighbours\n",
            r.defects.empty() ? "" : "\n", r.defects.empty() ? "no" : fmt::format("{}", r.defects.size()), r.passes,
            r.step_over, 100 * r.coverage(), r.points);
        const std::string thresholds = thresholds_text(r);
        if (!thresholds.empty()) text += fmt::format("thresholds: {}; {}\n", thresholds, r.note);
        if (q.scallop > 0)
            text += fmt::format("scallop between clean passes with {}: {:.2f} µm\n", to_text(q.tool), um(q.scallop));
        if (q.formed != nullptr && !q.formed->patches.empty()) {
            const FormedReport& f = *q.formed;
            const RoughPatch& roughest = f.patches[f.roughest];
            text += fmt::format(
                "formed surface, {} patches: Ra {:.2f}, Rz {:.2f} (at most {:.2f}, at {:.2f} {:.2f} {:.2f}), Sa {:.2f}, Sz {:.2f} µm, cut-off {:g} mm\n",
                f.patches.size(), um(f.ra), um(f.rz), um(roughest.profile.rz), roughest.contact.x(),
                roughest.contact.y(), roughest.contact.z(), um(f.sa), um(f.sz), f.cutoff);
        }
        if (!r.has_lag) text += "no measured positions: depths are those of the commanded path alone\n";
        if (!r.expected.empty())
            text += fmt::format("{} more at the border of the part, where a pass has one neighbour only: not counted\n",
                                r.expected.size());
    }
    for (const BudgetLine& line : q.budget) {
        text += fmt::format("budget {:<28} {:>10.4g} of {:<10.4g} {}\n", line.name, line.measured, line.limit,
                            !r.judgement.judged() ? "NOT JUDGED"
                            : line.held           ? "held"
                                                  : "NOT HELD");
    }
    return text;
}

}  // namespace clsurf::io

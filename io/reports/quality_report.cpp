#include "io/reports/quality_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"
#include "io/files/json_value.h"
#include "io/reports/defect_fingerprint.h"
#include "io/reports/defect_json.h"
#include "io/reports/fidelity_report.h"
#include "io/reports/joined_reports.h"
#include "io/reports/limit_reports.h"
#include "io/reports/line_ranges.h"
#include "io/reports/measured_json.h"
#include "io/reports/measured_report.h"
#include "io/reports/quality_words.h"
#include "limits/limit_budget.h"

namespace clsurf::io {
namespace {

constexpr double worth_saying = 0.005;  ///< least share without a form that the text mentions

double um(double mm) { return mm * um_per_mm; }
double per_minute(double per_second) { return per_second * seconds_per_minute; }

/// The defects, with the results of the as-machined surface and of colour differences.
Json looked_at_defects(const ReportedQuality& q) {
    Json all = list_defects(q.report->defects, q.scallop);
    const std::vector<std::string> fingerprints = fingerprints_of(q.report->defects);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (q.as_machined != nullptr) {
            const AsMachinedMark& mark = q.as_machined->marks[i];
            all[i]["formed_um"] = number(um(mark.depth), 2);
            all[i]["formed_note"] = mark.note == MarkNote::none ? Json(nullptr) : Json(std::string(name_of(mark.note)));
        }
        if (q.baseline != nullptr) all[i]["baseline"] = name_of(q.baseline->states[i]);
        if (i < q.colour_differences.size()) all[i]["delta_e00"] = number(q.colour_differences[i], 1);
        all[i]["fingerprint"] = fingerprints[i];
        all[i]["accepted"] = q.acceptance != nullptr && q.acceptance->accepts(i);
        if (q.acceptance != nullptr && !q.acceptance->of_defect[i].comment.empty())
            all[i]["comment"] = q.acceptance->of_defect[i].comment;
    }
    return all;
}

/// The entries of the file of accepted defects, and their state.
Json accepted_json(const ReportedQuality& q) {
    Json all = Json::array();
    if (q.acceptance == nullptr) return all;
    const std::vector<std::string> fingerprints = fingerprints_of(q.report->defects);
    for (std::size_t i = 0; i < fingerprints.size(); ++i) {
        const Acceptance::Entry& entry = q.acceptance->of_defect[i];
        if (!entry.listed) continue;
        all.push_back({{"fingerprint", fingerprints[i]},
                       {"state", entry.accepted ? "accepted"
                                 : entry.worse  ? "worse"
                                                : "commented"},
                       {"id", i + 1},
                       {"comment", entry.comment}});
    }
    for (const AcceptedDefect& named : q.acceptance->unknown)
        all.push_back(
            {{"fingerprint", named.fingerprint}, {"state", "unknown"}, {"id", nullptr}, {"comment", named.comment}});
    return all;
}

void add_motion(Json& summary, const MotionQuality& m) {
    summary["time_in_motion_s"] = number(m.duration, 6);
    summary["speed_difference_p95_mm_min"] = number(m.mismatch * seconds_per_minute, 3);
    summary["speed_difference_rms_mm_min"] = number(m.mismatch_rms * seconds_per_minute, 3);
    summary["jerk_p95_mm_s3"] = number(m.jerk, 1);
    summary["jerk_rms_mm_s3"] = number(m.jerk_rms, 1);
}

void add_roughness(Json& summary, const PartRoughness& f) {
    const auto known = [&](double mm) { return f.patches.empty() ? Json(nullptr) : number(um(mm), 3); };
    summary["ra_um"] = known(f.ra);
    summary["rz_um"] = known(f.rz);
    summary["rz_most_um"] = known(f.patches.empty() ? 0 : f.patches[f.roughest].profile.rz);
    summary["sa_um"] = known(f.sa);
    summary["sq_um"] = known(f.sq);
    summary["sz_um"] = known(f.sz);
    const auto of_machine = [&](double mm) { return f.machine.cells == 0 ? Json(nullptr) : number(um(mm), 3); };
    summary["machine_sa_um"] = of_machine(f.machine.sa);
    summary["machine_sq_um"] = of_machine(f.machine.sq);
    summary["machine_sz_um"] = of_machine(f.machine.sz);
    summary["roughness_cutoff_mm"] = number(f.cutoff);
    summary["roughness_patches"] = f.patches.size();
    summary["form_unknown_percent"] = number(100 * f.unknown, 1);
}

Json patches_json(const PartRoughness& f) {
    Json all = Json::array();
    for (const RoughPatch& patch : f.patches) {
        all.push_back({{"point", patch.point},
                       {"position_mm", vector(patch.contact)},
                       {"ra_um", number(um(patch.profile.ra), 3)},
                       {"rq_um", number(um(patch.profile.rq), 3)},
                       {"rz_um", number(um(patch.profile.rz), 3)},
                       {"sa_um", number(um(patch.area.sa), 3)},
                       {"sq_um", number(um(patch.area.sq), 3)},
                       {"sz_um", number(um(patch.area.sz), 3)},
                       {"machine_sq_um", patch.machine.cells == 0 ? Json(nullptr) : number(um(patch.machine.sq), 3)},
                       {"form_unknown_percent", number(100 * patch.unknown, 1)}});
    }
    return all;
}

/// Limits of the machine are judged even if the passes are not.
bool is_limit(const BudgetLine& line) {
    const auto limits = limit_budget_limits();
    return std::any_of(limits.begin(), limits.end(), [&](const auto& row) { return row.name == line.name; });
}

std::string roughness_text(const PartRoughness& f) {
    if (f.patches.empty()) return {};
    const RoughPatch& roughest = f.patches[f.roughest];
    std::string text = fmt::format(
        "as-machined surface, {} patches: Ra {:.2f}, Rz {:.2f} (at most {:.2f}, at {}), Sa {:.2f}, Sz {:.2f} µm, {}\n",
        f.patches.size(), um(f.ra), um(f.rz), um(roughest.profile.rz), coordinates_text(roughest.contact), um(f.sa),
        um(f.sz), cutoff_text(f.cutoff));
    if (f.unknown >= worth_saying)
        text +=
            fmt::format("form not known on {:.0f} % of these patches (creases, fillets, borders): not measured there\n",
                        100 * f.unknown);
    if (f.machine.cells > 0)
        text += fmt::format(
            "of this the machine adds Sa {:.2f}, Sq {:.2f}, Sz {:.2f} µm to what the commanded path leaves, creases and fillets included\n",
            um(f.machine.sa), um(f.machine.sq), um(f.machine.sz));
    return text;
}

/// The verdict, with the most conspicuous finding.
std::string verdict_text(const QualityReport& r) {
    std::string text;
    if (r.judgement.judged()) {
        text = verdict_of(r) + "\n";
    } else {
        for (const std::string& reason : r.judgement.reasons) text += fmt::format("NOT JUDGED: {}\n", reason);
    }
    if (r.defects.empty()) return text;
    constexpr std::size_t most_ranges = 3;
    const Defect& worst = r.defects.front();
    return text +
           fmt::format("Stands out most: {}, {}.\n\n", sentence_of(worst), named_line_ranges(worst, most_ranges));
}

/// As many ranges of lines as fit next to the numbers, at most three.
std::size_t ranges_in_column(const Defect& d) {
    constexpr std::size_t widest = 21;
    std::size_t shown = 3;
    while (shown > 1 && line_ranges(d, shown).size() > widest) --shown;
    return shown;
}

/// Why depths in the as-machined surface are missing, or differ from those of the passes alone: one line per reason.
std::string as_machined_notes(const ReportedQuality& q) {
    std::string text;
    for (const MarkNote note :
         {MarkNote::unknown_form, MarkNote::uneven_passes, MarkNote::cut_away, MarkNote::other_passes}) {
        std::string ranks;
        for (std::size_t i = 0; i < q.as_machined->marks.size(); ++i) {
            if (q.as_machined->marks[i].note == note && !q.report->defects[i].systematic)
                ranks += fmt::format("{}{}", ranks.empty() ? "" : ", ", i + 1);
        }
        if (!ranks.empty()) text += fmt::format("formed {}: {}\n", ranks, sentence_of(note));
    }
    return text.empty() ? text : "\n" + text;
}

std::string depth_column(const Defect& d) {
    if (d.systematic) return fmt::format("±{:.1f}", um(d.depth));
    return um(d.depth) < 0.05 ? "0.0" : fmt::format("{:.1f} {}", um(d.depth), shape_of(d));
}

std::string formed_column(const ReportedQuality& q, std::size_t i) {
    if (q.as_machined == nullptr) return {};
    const double depth = um(q.as_machined->marks[i].depth);
    return q.report->defects[i].systematic || std::isnan(depth) ? "       -" : fmt::format(" {:>7.1f}", depth);
}

/// One row per defect; in a narrow text places and lines are in a second one.
std::string defects_table(const ReportedQuality& q) {
    constexpr std::size_t least_for_one_row = 120;
    const QualityReport& r = *q.report;
    if (r.defects.empty()) return {};
    const bool one_row = q.columns >= least_for_one_row;
    const bool as_machined = q.as_machined != nullptr;
    const std::string_view where = place_word(r.defects.front().place);
    std::string text = fmt::format("{:>4} {:<8} {:<13} {:>7} {:>7} {:>14} {:>7}{}{}\n", "rank", "severity", "cause",
                                   "times", "speed", "depth", "length", as_machined ? "  formed" : "",
                                   one_row ? fmt::format("  {:<22} lines", fmt::format("{} X Y Z", where)) : "");
    text += fmt::format("{:>4} {:<8} {:<13} {:>7} {:>7} {:>14} {:>7}{}{}\n", "", "", "", "limit", "[%]", "[µm]", "[mm]",
                        as_machined ? "    [µm]" : "", one_row ? "  [mm]" : "");
    for (std::size_t i = 0; i < r.defects.size(); ++i) {
        const Defect& d = r.defects[i];
        text += fmt::format("{:>4} {:<8} {:<13} {:>7.1f} {:>7} {:>14} {:>7.1f}{}", i + 1, name_of_severity(d.severity),
                            name_of(d.cause), d.score, signed_text(100 * d.speed_mismatch, 1), depth_column(d),
                            d.length, formed_column(q, i));
        text += one_row
                    ? fmt::format("  {:<22} {}\n", coordinates_text(d.place.position()),
                                  line_ranges(d, ranges_in_column(d)))
                    : fmt::format("\n     {}, {}\n", place_text(d.place), named_line_ranges(d, ranges_in_column(d)));
    }
    if (as_machined) text += as_machined_notes(q);
    if (q.acceptance != nullptr && q.acceptance->count() > 0)
        text += fmt::format("\n{}\n", accepted_text(*q.acceptance));
    return text + "\n";
}

/// The new defects, by rank.
std::string against_baseline(const RecordedMatch& match) {
    std::string text = "against the baseline: " + baseline_text(match) + "\n";
    for (const DefectState state : {DefectState::fresh, DefectState::worse}) {
        std::string ranks;
        for (std::size_t i = 0; i < match.states.size(); ++i) {
            if (match.states[i] == state) ranks += fmt::format("{}{}", ranks.empty() ? "" : ", ", i + 1);
        }
        if (!ranks.empty()) text += fmt::format("{}: {}\n", name_of(state), ranks);
    }
    return text;
}

std::string subprogram_columns(const DefectSection& section) {
    return section.file.empty()
               ? ",,"
               : fmt::format("{},{},{}", csv_field(section.file), section.file_first_line, section.file_last_line);
}

}  // namespace

std::string baseline_text(const RecordedMatch& match) {
    const auto count = [&](DefectState state) { return std::ranges::count(match.states, state); };
    return fmt::format("{} new defects, {} worse, {} gone, {} as before", count(DefectState::fresh),
                       count(DefectState::worse), match.gone.size(), count(DefectState::unchanged));
}

namespace {

double value_of(const std::array<float, quantities>& values, Quantity which) {
    return static_cast<double>(values[index_of(which)]);
}

Json thresholds_json(const QualityReport& r) {
    const std::array<float, quantities>& of = r.thresholds.of;
    return {{"speed_percent", number(100 * value_of(of, Quantity::speed), 3)},
            {"acceleration_mm_s2", number(value_of(of, Quantity::acceleration), 2)},
            {"lag_um", r.has_lag ? number(um(value_of(of, Quantity::normal_deviation)), 3) : Json(nullptr)},
            {"relief_um", number(um(value_of(of, Quantity::relief)), 3)}};
}

}  // namespace

std::string quality_json(const ReportedQuality& q) {
    const QualityReport& r = *q.report;
    Json budget = Json::array();
    for (const BudgetLine& line : q.budget) {
        budget.push_back({{"name", line.name},
                          {"limit", number(line.limit)},
                          {"measured", number(line.measured, 3)},
                          {"held", line.held}});
    }
    Json summary{{"judged", r.judgement.judged()},
                 {"not_judged_reasons", r.judgement.reasons},
                 {"verdict", verdict_of(r)},
                 {"points", r.points},
                 {"passes", r.passes},
                 {"defects", r.defects.size()},
                 {"accepted", q.acceptance != nullptr ? q.acceptance->count() : 0},
                 {"expected", r.expected.size()},
                 {"worst_severity", r.worst_severity()},
                 {"scallop_um", number(um(q.scallop), 3)},
                 {"step_over_mm", number(r.step_over, 4)},
                 {"coverage_percent", number(100 * r.coverage(), 2)},
                 {"not_finishing_percent", number(100 * r.not_finishing_share(), 2)},
                 {"measured_positions", r.has_lag},
                 {"speed_mismatch_p99_percent", number(100 * value_of(r.thresholds.p99, Quantity::speed), 3)},
                 {"acceleration_mismatch_p99_mm_s2", number(value_of(r.thresholds.p99, Quantity::acceleration), 2)},
                 {"thresholds", thresholds_json(r)},
                 {"filter", r.note},
                 {"tool", q.tool ? Json(to_text(*q.tool)) : Json(nullptr)},
                 {"budget", std::move(budget)},
                 {"within_budget", r.judgement.judged() && all_held(q.budget)}};
    if (q.baseline != nullptr) {
        summary["new_defects"] = std::ranges::count(q.baseline->states, DefectState::fresh);
        summary["worse_defects"] = std::ranges::count(q.baseline->states, DefectState::worse);
        summary["gone_defects"] = q.baseline->gone.size();
    }
    if (q.as_machined != nullptr) add_roughness(summary, q.as_machined->roughness);
    if (q.motion) add_motion(summary, *q.motion);
    Json json{{"defects", looked_at_defects(q)},
              {"expected", list_defects(q.report->expected, q.scallop)},
              {"accepted", accepted_json(q)},
              {"summary", std::move(summary)}};
    if (q.as_machined != nullptr) json["roughness"] = patches_json(q.as_machined->roughness);
    if (q.limits != nullptr) {
        json["limits"] = limits_json(*q.limits, *q.program);
        json["limits_judged"] = judged_limits_json(*q.limits);
    }
    if (q.measured != nullptr) json["measured"] = measured_json(*q.measured);
    json["simulation"] = nullptr;
    if (q.origin)
        json["simulation"] = {{"machine", q.origin->machine}, {"fidelity", fidelity_json(q.origin->fidelity)}};
    json["diagnostics"] = list(*q.diagnostics);
    return dump(json);
}

std::string quality_csv_titles() {
    return fmt::format(
        "id,severity,cause,pass,first_line,last_line,first_point,last_point,x [mm],y [mm],z [mm],depth [µm],shape,"
        "speed jump [mm/min],acceleration jump [mm/s²],length [mm],area [mm²],score,speed jump [%],quantity,systematic,place,file,file_first_line,file_last_line,{},accepted,comment\n",
        limit_column_titles());
}

std::string quality_csv(const ReportedQuality& q) {
    std::string text = quality_csv_titles();
    for (std::size_t i = 0; i < q.report->defects.size(); ++i) {
        const Defect& d = q.report->defects[i];
        const Vec3& at = d.place.position();
        for (const DefectSection& section : d.sections) {
            text += fmt::format(
                "{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.3f},{},{:.1f},{:.1f},{:.3f},{:.4f},{:.2f},{:.1f},{},{},{},{},,,,,,,,,{},{}\n",
                i + 1, d.severity, name_of(d.cause), section.pass, section.first_line, section.last_line,
                section.points.first, section.points.last, at.x(), at.y(), at.z(), um(d.depth), shape_of(d),
                per_minute(d.speed_jump), d.acceleration_jump, d.length, d.area, d.score, 100 * d.speed_mismatch,
                name_of(d.quantity), d.systematic, place_word(d.place), subprogram_columns(section),
                q.acceptance != nullptr && q.acceptance->accepts(i),
                q.acceptance != nullptr ? csv_field(q.acceptance->of_defect[i].comment) : std::string());
        }
    }
    if (q.limits != nullptr) text += limits_csv(*q.limits, q.report->defects.size() + 1);
    return text;
}

std::string quality_text(const ReportedQuality& q) {
    const QualityReport& r = *q.report;
    std::string text = q.limits != nullptr ? limits_text(*q.limits, *q.program) : std::string();
    text += verdict_text(r) + defects_table(q);
    if (r.passes < 2 || r.step_over <= 0) {
        text += "no adjacent passes: nothing to compare\n";
    } else {
        text += fmt::format(
            "{} {} on {} passes, {:.3g} mm apart; {:.1f} % of {} cutting points compared with both neighbours\n",
            r.defects.size(), r.defects.size() == 1 ? "defect" : "defects", r.passes, r.step_over, 100 * r.coverage(),
            r.points);
        if (r.not_finishing > 0)
            text += fmt::format(
                "{:.1f} % of all cutting points belong to pockets, drilling or single contours: not finishing passes\n",
                100 * r.not_finishing_share());
        const std::string thresholds = thresholds_text(r);
        if (!thresholds.empty()) text += fmt::format("thresholds: {}; {}\n", thresholds, r.note);
        if (q.scallop > 0)
            text += fmt::format("scallop between passes without defects, with {}: {:.2f} µm\n", to_text(*q.tool),
                                um(q.scallop));
        if (q.as_machined != nullptr) text += roughness_text(q.as_machined->roughness);
        if (!r.has_lag) text += "no measured positions: depths are those of the commanded path alone\n";
        if (!r.expected.empty())
            text += fmt::format("{} more at the border of the part, where a pass has one neighbour only: not counted\n",
                                r.expected.size());
    }
    if (q.measured != nullptr) text += measured_text(*q.measured);
    for (const BudgetLine& line : q.budget) {
        text += fmt::format("budget {:<28} {:>10.4g} of {:<10.4g} {}\n", line.name, line.measured, line.limit,
                            line.held                                  ? "kept"
                            : !r.judgement.judged() && !is_limit(line) ? "NOT JUDGED"
                                                                       : "NOT KEPT");
    }
    if (q.baseline != nullptr) text += against_baseline(*q.baseline);
    return text + origin_text(q.origin);
}

}  // namespace clsurf::io

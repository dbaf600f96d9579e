#include "history/record_of.h"

#include <algorithm>

#include "core/units.h"

namespace clsurf {
namespace {

RunMismatch mismatch_of(const Thresholds& thresholds, Quantity quantity, double per_inside) {
    const std::size_t k = index_of(quantity);
    return {per_inside * static_cast<double>(thresholds.median[k]),
            per_inside * static_cast<double>(thresholds.p99[k])};
}

}  // namespace

std::vector<RecordedDefect> recorded_defects(const QualityReport& report) {
    std::vector<RecordedDefect> all;
    for (const Defect& d : report.defects) {
        RecordedDefect r;
        r.cause = name_of(d.cause);
        r.quantity = name_of(d.quantity);
        r.severity = d.severity;
        r.score = static_cast<double>(d.score);
        r.depth_um = d.depth * um_per_mm;
        r.pit = d.pit;
        r.systematic = d.systematic;
        r.speed_jump_percent = 100 * d.speed_mismatch;
        r.length_mm = d.length;
        r.area_mm2 = d.area;
        r.tip = d.place.tip;
        r.position = d.place.position();
        for (const DefectSection& section : d.sections)
            r.sections.push_back({section.pass, section.first_line, section.last_line});
        all.push_back(std::move(r));
    }
    return all;
}

RunRecord record_of(const Part& part, const Quality& quality, bool within_budget) {
    const QualityReport& report = quality.report;
    RunRecord run;
    if (part.tool) run.tool = to_text(*part.tool);
    run.duration_s = part.log.records > 0 ? part.log.time_of(part.log.records - 1) : 0;
    run.points = report.points;
    run.passes = report.passes;
    run.judged = report.judgement.judged();
    for (const std::string& reason : report.judgement.reasons)
        run.not_judged_reasons += (run.not_judged_reasons.empty() ? "" : " ") + reason;
    run.within_budget = within_budget;
    run.coverage_percent = 100 * report.coverage();
    run.speed_percent = mismatch_of(report.thresholds, Quantity::speed, 100);
    run.acceleration_mm_s2 = mismatch_of(report.thresholds, Quantity::acceleration, 1);
    if (report.has_lag) run.lag_um = mismatch_of(report.thresholds, Quantity::normal_deviation, um_per_mm);
    run.defects = static_cast<std::int64_t>(report.defects.size());
    run.worst_severity = report.worst_severity();
    for (const Defect& defect : report.defects) {
        run.worst_score = std::max(run.worst_score, static_cast<double>(defect.score));
        run.deepest_um = std::max(run.deepest_um, defect.depth * um_per_mm);
        run.area_mm2 += defect.area;
    }
    if (quality.as_machined && !quality.as_machined->roughness.patches.empty()) {
        run.ra_um = quality.as_machined->roughness.ra * um_per_mm;
        run.rz_um = quality.as_machined->roughness.rz * um_per_mm;
    }
    run.found = recorded_defects(report);
    return run;
}

}  // namespace clsurf

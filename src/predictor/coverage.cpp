#include "predictor/coverage.h"

#include <cmath>

#include <fmt/format.h>

namespace clsurf {
namespace {

/// Refuses a verdict if too little could be compared.
void judge_passes(QualityReport& report) {
    if (report.not_finishing_share() > 1 - least_coverage) {
        report.judgement.refuse(fmt::format(
            "{:.0f} % of the cutting points belong to no finishing passes, so nothing could be compared with them.",
            100 * report.not_finishing_share()));
    }
    if (report.points == 0 && report.not_finishing > 0) return;
    if (report.points == 0) {
        report.judgement.refuse("The log has no cutting points.");
    } else if (report.step_over <= 0) {
        report.judgement.refuse("No pass has an adjacent pass, so nothing could be compared.");
    } else if (report.coverage() < least_coverage) {
        const double percent = std::floor(1000 * report.coverage()) / 10;  // never rounded up to the limit
        const auto share = [&](PointIndex points) {
            return 100.0 * static_cast<double>(points) / static_cast<double>(report.points);
        };
        report.judgement.refuse(fmt::format(
            "Only {:.1f} % of {} cutting points could be compared with the passes on both sides: {:.1f} % lie near "
            "the ends of passes, which are not judged, and {:.1f} % have no adjacent pass on one side or on "
            "both. A verdict needs {:.0f} %.",
            percent, report.points, share(report.points - report.away_from_ends),
            share(report.away_from_ends - report.compared), 100 * least_coverage));
    }
}

/// Adds the reason if records are too far apart to distinguish passes. `record` [mm]: arc length of one record.
void judge_records(double record, QualityReport& report) {
    if (report.step_over <= 0 || report.coverage() >= least_coverage || !(record > report.step_over)) return;
    report.judgement.refuse(fmt::format(
        "Records are {:.2f} mm apart at the usual speed and passes {:.2f} mm: which pass is adjacent to a point cannot be determined.",
        record, report.step_over));
}

/// Refuses a verdict if the heights of adjacent passes differ by as much as the step-over all over the part. The surface of
/// one operation has no such heights, unlike a semi-finish and a finish with one tool, one above the other.
void judge_heights(QualityReport& report) {
    // See docs/design/predictor.md#6-decide-whether-the-data-allow-a-verdict, Several tools.
    constexpr double most_of_step_over = 0.5;
    const double height = report.thresholds.of[index_of(Quantity::relief)];
    if (report.step_over <= 0 || !std::isfinite(height) || height <= most_of_step_over * report.step_over) return;
    report.judgement.refuse(fmt::format(
        "Heights of adjacent passes differ by up to {:.0f} µm all over the part, and passes lie {:.2f} mm apart: several "
        "operations with one tool over one area? Judge each from a log of its own.",
        1e3 * height, report.step_over));
}

}  // namespace

void judge_coverage(double record, QualityReport& report) {
    judge_passes(report);
    judge_records(record, report);
    judge_heights(report);
}

}  // namespace clsurf

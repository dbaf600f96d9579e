#include "cli/runs/run_alignment.h"

#include <fmt/format.h>

namespace clsurf::cli {

void require_alignment(const RunDifferences& differences, const std::string& a, const std::string& b) {
    if (differences.alignment.aligned > 0) return;
    throw InputError(
        Place::of_file(b), "nowhere runs along the path of " + a,
        "another part, or another work offset? --work-offset holds for all runs; `clsurf info` shows what a log states");
}

void note_left_out(const RunReport& report, const LoadedRun& b, const std::string& a, Diagnostics& diagnostics) {
    constexpr double few = 0.02;  // allows another approach or retract
    const double left_out = report.arc_length_of_b - report.aligned_of_b;
    if (left_out <= few * report.arc_length_of_b) return;
    const PointRange& points = report.left_out_of_b;
    diagnostics.add(
        {Severity::warning, "compare.left-out", Place::of_file(b.name),
         fmt::format(
             "{:.1f} of its {:.1f} mm are not compared: {} has no such path, or has it only once. Longest part: "
             "points {}–{}, {:.3f} s",
             left_out, report.arc_length_of_b, a, points.first, points.last,
             b.log.time_of(points.last) - b.log.time_of(points.first)),
         "a second run in this log, or lines that ran twice? Where it is the first argument, all its runs are compared"});
}

}  // namespace clsurf::cli

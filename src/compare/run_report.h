#pragma once
// Run report: the sections where two runs differ, totals, and the comparison with a budget.

#include <optional>
#include <string>
#include <vector>

#include "compare/run_difference.h"
#include "core/cutter_place.h"
#include "mapping/line_map.h"

namespace clsurf {

/// A section of A along which one quantity differs from B by more than its threshold, in one direction.
struct RunDifferenceSection {
    RunQuantity quantity = RunQuantity::speed;
    PointRange points, points_of_b;
    PointIndex point = 0;                         ///< point of A with the largest difference
    CutterPlace place;                            ///< of A there
    double peak = 0, mean = 0;                    ///< B − A, inside units; the mean by arc length
    double relative_peak = 0, relative_mean = 0;  ///< of a speed: relative to A's
    double length = 0;                            ///< [mm]
    double time = 0;                              ///< [s] additional time of B
    LineNumber first_line = 0, last_line = 0;     ///< 0: not known
    double score = 0;                             ///< peak over threshold
};

/// One quantity over everything that was compared, by arc length.
struct RunQuantitySummary {
    RunQuantity quantity = RunQuantity::speed;
    double arc_length = 0;              ///< [mm] compared
    double threshold = 0;               ///< inside units
    double mean = 0, rms = 0, p95 = 0;  ///< p95 of the absolute values
    double lowest = 0, highest = 0;
    double begin = 0, end = 0;  ///< medians over the first and the last tenth of the path: a drift
    double over = 0;            ///< share of the path beyond the threshold, 0 … 1
    PointIndex sections = 0;    ///< number of sections that differ
    double relative_most = 0;   ///< of a speed: the largest, relative to A's, ≥ 0
};

struct RunReport {
    std::vector<RunDifferenceSection> sections;    ///< worst first, at most 1000 of a quantity
    std::vector<RunQuantitySummary> quantities;    ///< those that are known
    double aligned = 0, arc_length = 0;            ///< [mm] of A
    double aligned_of_b = 0, arc_length_of_b = 0;  ///< [mm]
    PointRange left_out_of_b;                      ///< the longest section of B that A does not have; empty: none
    double time = 0, time_of_b = 0;                ///< [s] of each run for the aligned sections

    [[nodiscard]] const RunQuantitySummary* find(RunQuantity q) const;
};

/// Sections shorter than 5 ms are noise; sections closer than 1 mm are joined. `lines`: maps points to lines of A's program;
/// nullptr: not known. O(points).
[[nodiscard]] RunReport report_run(const ComparedRun& a, const ClSurface& surface, const LineMap* lines,
                                   const ComparedRun& b, const RunDifferences& differences);

}  // namespace clsurf

#include "limits/finding_runs.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace clsurf {
namespace {

// Without it, a run with exact stops had 10,603 findings with a factor of 1.00000004.
constexpr double arithmetic = 1e-6;  ///< share of a limit: rounding errors of sums of doubles, also those of a planner

double least_factor(const JudgedLimit& limit) { return limit.factor - limit.uncertainty; }

/// The greatest value counts, reduced by rounding and the clock: of two similar values the more accurate one. The
/// uncertainty from bends is not random and is not subtracted: the peak remains the greatest observed value.
void extend(RecordRun& run, const RecordRun& next) {
    const PointRange points{run.finding.points.first, next.finding.points.last};
    run.least_factor = std::max(run.least_factor, next.least_factor);
    if (next.clear > run.clear) {
        run.finding = next.finding;
        run.clear = next.clear;
    }
    run.finding.points = points;
}

}  // namespace

void RecordRuns::append(const RecordRuns& next) {
    if (next.any && (!any || least_factor(next.greatest) > least_factor(greatest))) greatest = next.greatest;
    any = any || next.any;
    for (const RecordRun& run : next.runs) {
        runs.push_back(run);
        runs.back().gap_reach = std::min(gap_reach, run.gap_reach);
        gap_reach = std::numeric_limits<double>::infinity();
    }
    gap_reach = std::min(gap_reach, next.gap_reach);
}

void RunFinder::add(PointIndex point, const MeasuredValue& measured, double limit) {
    const double factor = measured.value / limit, share = measured.uncertainty / limit;
    if (!std::isfinite(factor)) {
        found_.gap_reach = 0;
        return;
    }
    if (!found_.any || factor - share > least_factor(found_.greatest)) {
        found_.greatest.factor = factor;
        found_.greatest.uncertainty = share;
    }
    found_.any = true;
    if (!(factor - share > 1 + arithmetic)) {
        found_.gap_reach = std::min(found_.gap_reach, factor + share);
        return;
    }
    RecordRun here;
    here.finding.limit = found_.greatest.limit;
    here.finding.limit.value = limit;
    here.finding.value = measured.value;
    here.finding.factor = factor;
    here.finding.uncertainty = share;
    here.finding.points = {point, point};
    here.finding.point = point;
    here.least_factor = factor - share;
    here.clear = factor - measured.noise / limit;
    here.gap_reach = found_.gap_reach;
    if (!found_.runs.empty() && found_.runs.back().finding.points.last + 1 == point) {
        extend(found_.runs.back(), here);
    } else {
        found_.runs.push_back(here);
    }
    found_.gap_reach = std::numeric_limits<double>::infinity();
}

std::vector<LimitFinding> findings_of(const RecordRuns& found, PointIndex longest_gap,
                                      const std::function<LineNumber(PointIndex)>& line_at) {
    std::vector<RecordRun> joined;
    for (const RecordRun& run : found.runs) {
        const PointIndex first = run.finding.points.first;
        const auto goes_on = [&](const RecordRun& last) {
            const PointIndex end = last.finding.points.last;
            if (first == end + 1) return true;
            return first - end - 1 <= longest_gap && run.gap_reach >= std::max(last.least_factor, run.least_factor) &&
                   line_at(end) == line_at(first);
        };
        if (!joined.empty() && goes_on(joined.back())) {
            extend(joined.back(), run);
        } else {
            joined.push_back(run);
        }
    }
    std::vector<LimitFinding> findings;
    std::ranges::transform(joined, std::back_inserter(findings), &RecordRun::finding);
    return findings;
}

}  // namespace clsurf

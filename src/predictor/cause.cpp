#include "predictor/cause.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/statistics.h"

namespace clsurf {
namespace {

constexpr double uneven_spacing = 1.5;       ///< ratio of the programmed steps
constexpr LineNumber most_lines = 10'000;    ///< of a run that are looked at
constexpr double corner_arc_length = 0.3;    ///< [mm] in which a corner turns
constexpr float corner_cosine = 0.906F;      ///< cos 25°
constexpr double reversal_arc_length = 0.3;  ///< [mm] before the run begins
constexpr float axis_moves = 0.01F;          ///< of the feed; less is noise
constexpr float lobe = 0.4F;                 ///< of the peak: a swing counts
constexpr int lobes_of_oscillation = 3;

/// How often the speed goes to the other side of that of the neighbours, within one run.
int count_lobes(std::span<const DefectCandidate* const> sites) {
    float peak = 0;
    for (const DefectCandidate* s : sites) {
        const float r = std::abs(s->comparison.residual[index_of(Quantity::speed)]);
        if (r > peak) peak = r;
    }
    int most = 0;
    int lobes = 0;
    int sign = 0;
    std::size_t pass = std::numeric_limits<std::size_t>::max();
    for (const DefectCandidate* s : sites) {
        if (s->pass != pass) {
            pass = s->pass;
            lobes = 0;
            sign = 0;
        }
        const float r = s->comparison.residual[index_of(Quantity::speed)];
        if (!(std::abs(r) >= lobe * peak)) continue;
        const int now = r > 0 ? 1 : -1;
        if (now != sign) ++lobes;
        sign = now;
        most = std::max(most, lobes);
    }
    return most;
}

}  // namespace

std::string_view name_of(Cause cause) {
    switch (cause) {
        case Cause::feed_drop: return "feed_drop";
        case Cause::oscillation: return "oscillation";
        case Cause::lag_step: return "lag_step";
        case Cause::point_spacing: return "point_spacing";
        case Cause::corner: return "corner";
        case Cause::reversal: return "reversal";
        case Cause::pass_end: return "pass_end";
    }
    return "";
}

std::string_view description_of(Cause cause) {
    switch (cause) {
        case Cause::feed_drop: return "runs at a different speed than the adjacent passes";
        case Cause::oscillation: return "its speed oscillates about that of the adjacent passes";
        case Cause::lag_step: return "axis lag differs from the adjacent passes";
        case Cause::point_spacing: return "programmed points are spaced differently from the adjacent passes";
        case Cause::corner: return "the programmed path turns here";
        case Cause::reversal: return "an axis reverses here";
        case Cause::pass_end: return "the pass begins or ends here";
    }
    return "";
}

double CauseFinder::spacing(std::span<const DefectRun> runs) const {
    std::vector<double> steps;
    for (const DefectRun& run : runs) {
        if (run.first_line == 0) continue;
        const LineNumber last = std::min(run.last_line, run.first_line + most_lines);
        for (LineNumber line = run.first_line; line <= last; ++line) {
            if (lines_.kind_of(line) != PointKind::cut) continue;
            for (const std::uint32_t motion : lines_.motions_of(line)) steps.push_back(toolpath_.length(motion));
        }
    }
    return steps.empty() ? 0 : median(steps);
}

bool CauseFinder::spaced_otherwise(const Defect& defect) const {
    const double own = spacing(defect.runs);
    const double beside = spacing(defect.neighbours);
    return own > 0 && beside > 0 && (own > uneven_spacing * beside || beside > uneven_spacing * own);
}

bool CauseFinder::turns(const DefectRun& run) const {
    PointIndex behind = run.points.first;
    for (PointIndex i = run.points.first; i <= run.points.last; ++i) {
        while (behind < i && arc_length_.at_least(behind, i, corner_arc_length)) ++behind;
        const float cosine = signals_.feed(behind).dot(signals_.feed(i));
        if (cosine < corner_cosine) return true;
    }
    return false;
}

bool CauseFinder::begins_with_reversal(const DefectRun& run) const {
    PointIndex from = run.points.first;
    while (from > 0 && !arc_length_.at_least(from, run.points.first, reversal_arc_length)) --from;
    const Eigen::Vector3f before = signals_.feed(from);
    PointIndex to = run.points.first;
    while (to < run.points.last && !arc_length_.at_least(run.points.first, to, reversal_arc_length)) ++to;
    const Eigen::Vector3f after = signals_.feed(to);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (before[axis] * after[axis] < 0 && std::min(std::abs(before[axis]), std::abs(after[axis])) > axis_moves)
            return true;
    }
    return false;
}

Cause CauseFinder::cause_of(const Defect& defect, std::span<const DefectCandidate* const> sites) const {
    if (defect.quantity == Quantity::relief || (defect.quantity != Quantity::lag && spaced_otherwise(defect)))
        return Cause::point_spacing;
    const auto most_runs = [&](auto&& test) {
        const auto runs = std::count_if(defect.runs.begin(), defect.runs.end(), test);
        return 2 * runs > static_cast<std::ptrdiff_t>(defect.runs.size());
    };
    if (most_runs([&](const DefectRun& run) { return turns(run); })) return Cause::corner;
    if (defect.quantity == Quantity::lag) {
        if (most_runs([&](const DefectRun& run) { return begins_with_reversal(run); })) return Cause::reversal;
        return Cause::lag_step;
    }
    return count_lobes(sites) >= lobes_of_oscillation ? Cause::oscillation : Cause::feed_drop;
}

}  // namespace clsurf

#include "repair/repair_mask.h"

#include <cmath>

#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr LineNumber most_lines_a_period = 50;

using Marks = std::vector<std::uint8_t>;  ///< per point

void mark(Marks& marks, const PointRange& points) {
    for (PointIndex i = points.first; i <= points.last; ++i) marks[static_cast<std::size_t>(i)] = 1;
}

Marks marked_places(const JudgedRun& run, const RepairMaskRules& rules) {
    Marks marks(static_cast<std::size_t>(run.surface.positions.size()), 0);
    const double step =
        rules.share * run.report.thresholds.of[index_of(Quantity::speed)] * run.report.thresholds.usual_speed;
    const double slow = rules.slow * run.report.thresholds.usual_speed;
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        if (run.signals[i].zone == Zone::outside) continue;
        const bool differs = std::abs(run.speed_differences[static_cast<std::size_t>(i)]) > step;
        if (differs || run.signals[i].speed < slow) marks[static_cast<std::size_t>(i)] = 1;
    }
    for (const Defect& defect : run.report.defects) {
        if (defect.quantity == Quantity::normal_deviation) continue;
        for (const DefectSection& r : defect.sections) mark(marks, r.points);
        for (const DefectSection& r : defect.neighbours) mark(marks, r.points);
    }
    return marks;
}

/// Also marks the places adjacent to each mark.
Marks spread_aside(const JudgedRun& run, const Marks& marks) {
    Marks spread = marks;
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        if (marks[static_cast<std::size_t>(i)] == 0) continue;
        for (const Side side : {Side::left, Side::right}) {
            const PathLocation at = adjacent_location(run.surface, {i, 0}, run.signals.feed(i), side);
            if (at.exists()) spread[static_cast<std::size_t>(at.nearest())] = 1;
        }
    }
    return spread;
}

/// All points within `reach` of arc length of a mark on its pass, forward or backward.
void spread_along(const JudgedRun& run, double reach, Marks& marks) {
    for (const Pass& pass : run.surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        const auto walk = [&](PointIndex from, PointIndex to, PointIndex step) {
            double left = -1;  // remaining reach
            for (PointIndex i = from; i != to + step; i += step) {
                if (i != from) left -= (run.surface.positions[i] - run.surface.positions[i - step]).norm();
                std::uint8_t& mine = marks[static_cast<std::size_t>(i)];
                if (mine == 1)
                    left = reach;
                else if (left >= 0)
                    mine = 2;
            }
        };
        walk(pass.first, pass.last, 1);
        walk(pass.last, pass.first, -1);
    }
}

}  // namespace

std::vector<std::uint8_t> marked_motions(const JudgedRun& run, const Program& program,
                                         const std::vector<std::uint8_t>& marks) {
    std::vector<std::uint8_t> marked_ones(static_cast<std::size_t>(program.motions.size()), 0);
    LineNumber line = 0;
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) {
        const LineNumber here = run.lines->line_at(i);
        if (here == 0) continue;
        const bool marked = marks[static_cast<std::size_t>(i)] != 0,
                   follows = marked && line != 0 && here > line && here - line <= most_lines_a_period &&
                             marks[static_cast<std::size_t>(i - 1)] != 0;
        if (marked) {
            for (LineNumber n = follows ? line + 1 : here; n <= here; ++n) {
                for (const std::uint32_t motion : run.lines->motions_of(n)) {
                    if (motion < marked_ones.size()) marked_ones[motion] = 1;
                }
            }
        }
        line = here;
    }
    return marked_ones;
}

std::vector<std::uint8_t> repair_mask(const JudgedRun& run, const Program& program, const RepairMaskRules& rules) {
    Marks marks = marked_places(run, rules);
    for (int k = 0; k < rules.passes_aside; ++k) marks = spread_aside(run, marks);
    spread_along(run, rules.reach, marks);
    return marked_motions(run, program, marks);
}

}  // namespace clsurf

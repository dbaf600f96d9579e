#include "pipeline/settled_defect.h"

#include <algorithm>
#include <array>
#include <vector>

#include "predictor/candidates.h"
#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr std::size_t passes_for_cause = 3;       ///< on one side, to find which of two passes causes the defect
constexpr std::size_t passes_for_lag = 8;         ///< on one side, to find whether a lag is systematic
constexpr std::size_t passes_next_to_defect = 3;  ///< on both sides, if one of these passes also causes a defect

/// The points next to a place on the passes of one side, the adjacent pass first.
std::vector<PointIndex> points_aside(const DefectSurroundings& around, PointIndex point, Side side) {
    std::vector<PointIndex> points;
    const auto feed = [&](const PathLocation& at) { return around.signals.feed(at.nearest()); };
    walk_aside(around.surface, {point, 0}, side, feed, [&](const PathLocation& at, const PathLocation&) {
        if (around.signals[at.nearest()].zone == Zone::outside) return false;
        points.push_back(at.nearest());
        return points.size() < passes_for_lag;
    });
    return points;
}

/// The last of the first `count` points.
PointIndex last_of(const std::vector<PointIndex>& points, std::size_t count) {
    return *std::max_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count));
}

/// The last one of a point and its neighbours on the adjacent passes.
PointIndex last_adjacent(const ClSurface& surface, PointIndex point) {
    PointIndex last = point;
    for (const Side side : {Side::left, Side::right}) {
        if (surface.neighbours.has(side, point)) last = std::max(last, surface.neighbours.neighbour(side, point));
    }
    return last;
}

/// The last point that is needed around the strongest place to find the causing pass; nullopt: there are too few passes.
std::optional<PointIndex> last_for_cause(const Defect& defect, const DefectSurroundings& around) {
    const std::array<std::vector<PointIndex>, 2> sides{points_aside(around, defect.point, Side::left),
                                                       points_aside(around, defect.point, Side::right)};
    const bool lag = defect.quantity == Quantity::normal_deviation && !defect.systematic;
    const bool adjacent_defect = std::any_of(sides.begin(), sides.end(), [&](const std::vector<PointIndex>& side) {
        const std::size_t count = std::min<std::size_t>(side.size(), passes_next_to_defect - 1);
        return std::any_of(side.begin(), side.begin() + static_cast<std::ptrdiff_t>(count), around.has_defect);
    });
    const std::size_t on_both = lag || adjacent_defect ? passes_next_to_defect : 1;
    const std::size_t on_one = lag ? passes_for_lag : passes_for_cause;
    if (std::min(sides[0].size(), sides[1].size()) < on_both) return std::nullopt;
    std::optional<PointIndex> last;
    for (const std::vector<PointIndex>& side : sides) {
        if (side.size() >= on_one && (!last || last_of(side, on_one) < *last)) last = last_of(side, on_one);
    }
    if (!last) return std::nullopt;
    return std::max({*last, last_of(sides[0], on_both), last_of(sides[1], on_both)});
}

}  // namespace

double settling_distance(const ClSurface& surface, double record) {
    return usual_end_zone(surface.step_over) + joined_along(surface, record);
}

std::optional<PointIndex> last_point_needed(const Defect& defect, const DefectSurroundings& around) {
    const std::optional<PointIndex> needed = last_for_cause(defect, around);
    if (!needed) return std::nullopt;
    PointIndex last = std::max(*needed, defect.point);
    for (const DefectSection& section : defect.sections)
        last = std::max({last, last_adjacent(around.surface, section.points.first),
                         last_adjacent(around.surface, section.points.last)});
    const PointIndex newest = around.surface.positions.size() - 1;
    if (!around.arc_length.at_least(last, newest, around.settling)) return std::nullopt;
    // Bisection for the first point at which the distance is sufficient.
    PointIndex not_enough = last, enough = newest;
    while (enough - not_enough > 1) {
        const PointIndex middle = not_enough + (enough - not_enough) / 2;
        (around.arc_length.at_least(last, middle, around.settling) ? enough : not_enough) = middle;
    }
    return enough;
}

}  // namespace clsurf

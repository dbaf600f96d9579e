#include "intervals/shared_boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace clsurf {
namespace {

// As in docs/optimize.md#intervals, point 5.
constexpr int passes_on_a_side = 2;
constexpr std::array<Side, 2> sides{Side::left, Side::right};

/// Direction of travel at a point. `first`: it is the first of its pass; the previous point belongs to the link from
/// another pass.
Eigen::Vector3f feed_at(const Positions& p, PointIndex i, bool first = false) {
    return i > 0 && !first ? Eigen::Vector3f(p[i] - p[i - 1]) : Eigen::Vector3f(p[i + 1] - p[i]);
}

/// The end of a motion that is nearest to a point.
PointIndex nearest_end(const ProgrammedPass& pass, PointIndex point) {
    const auto after = std::lower_bound(pass.ends.begin(), pass.ends.end(), point);
    if (after == pass.ends.end()) return pass.ends.back();
    if (after == pass.ends.begin() || *after - point <= point - *(after - 1)) return *after;
    return *(after - 1);
}

/// The end of a motion that is nearest to the place `offset` [mm] after a boundary, along the pass.
PointIndex moved(const ProgrammedPass& pass, const Positions& p, PointIndex boundary, double offset) {
    auto at = std::lower_bound(pass.ends.begin(), pass.ends.end(), boundary);
    if (at == pass.ends.end() || *at != boundary) return boundary;
    const int step = offset > 0 ? 1 : -1;
    double rest = std::abs(offset);
    while (step > 0 ? at + 1 != pass.ends.end() : at != pass.ends.begin()) {
        const double length = (p[*(at + step)] - p[*at]).norm();
        if (rest < 0.5 * length) break;
        rest -= length;
        at += step;
    }
    return *at;
}

}  // namespace

AdjacentBoundaries::AdjacentBoundaries(const ProgrammedSurface& programmed, const PassBoundaries& boundaries,
                                       double reach)
    : programmed_(programmed), reach_(reach) {
    for (const std::vector<PointIndex>& pass : boundaries)
        boundaries_.insert(boundaries_.end(), pass.begin(), pass.end());
    std::sort(boundaries_.begin(), boundaries_.end());
}

double AdjacentBoundaries::offset_from(const PathLocation& at, const Eigen::Vector3f& feed) const {
    const Positions& p = programmed_.surface.positions;
    const Eigen::Vector3f here = position_at(p, at);
    const auto after = std::lower_bound(boundaries_.begin(), boundaries_.end(), at.nearest());
    double nearest = reach_, offset = std::numeric_limits<double>::quiet_NaN();
    const auto consider = [&](PointIndex boundary) {
        const Eigen::Vector3f to_boundary = p[boundary] - here;
        if (to_boundary.norm() > nearest) return;
        nearest = to_boundary.norm();
        offset = to_boundary.dot(feed.normalized());
    };
    if (after != boundaries_.end()) consider(*after);
    if (after != boundaries_.begin()) consider(*(after - 1));
    return offset;
}

bool AdjacentBoundaries::has_at(const PathLocation& at) const {
    return std::isfinite(offset_from(at, feed_at(programmed_.surface.positions, at.nearest())));
}

AdjacentBoundaries::Places AdjacentBoundaries::around(PointIndex point) const {
    const ClSurface& surface = programmed_.surface;
    const Eigen::Vector3f feed = feed_at(surface.positions, point);
    Places places;
    for (const Side side : sides) {
        int passes = 0;
        const auto here = [&](const PathLocation&) { return feed; };
        walk_aside(surface, {point, 0}, side, here, [&](const PathLocation& at, const PathLocation&) {
            if (const double offset = offset_from(at, feed); std::isfinite(offset)) places.offsets.push_back(offset);
            return ++passes < passes_on_a_side;
        });
        places.passes += passes;
    }
    return places;
}

std::vector<PointIndex> AdjacentBoundaries::missing_on_adjacent(PointIndex boundary, bool first) const {
    const ClSurface& surface = programmed_.surface;
    const Eigen::Vector3f feed = feed_at(surface.positions, boundary, first);
    std::vector<PointIndex> missing;
    for (const Side side : sides) {
        const PathLocation here{boundary, 0}, at = adjacent_location(surface, here, feed, side);
        if (!at.exists() || has_at(at)) continue;
        const PathLocation next = beyond(surface, here, at, feed);
        if (next.exists() && has_at(next)) missing.push_back(at.nearest());
    }
    return missing;
}

PassBoundaries share_boundaries(const ProgrammedSurface& programmed, const std::vector<ProgrammedPass>& passes,
                                const PassBoundaries& boundaries, double reach) {
    const AdjacentBoundaries adjacent(programmed, boundaries, reach);
    const Positions& p = programmed.surface.positions;
    PassBoundaries shared(boundaries.size());
    std::vector<PointIndex> missing;
    for (std::size_t k = 0; k < boundaries.size(); ++k) {
        const std::vector<PointIndex>& own = boundaries[k];
        for (std::size_t b = 0; b < own.size(); ++b) {
            const std::vector<PointIndex> missing_here = adjacent.missing_on_adjacent(own[b], b == 0);
            missing.insert(missing.end(), missing_here.begin(), missing_here.end());
            if (b == 0 || b + 1 == own.size()) {
                shared[k].push_back(own[b]);
                continue;
            }
            std::vector<double> offsets = adjacent.around(own[b]).offsets;
            offsets.push_back(0);
            // The median of an even number is the mean of the middle two, so that it is the same in both directions.
            shared[k].push_back(moved(passes[k], p, own[b], midpoint_median(offsets)));
        }
    }
    std::sort(missing.begin(), missing.end());
    auto next = missing.begin();
    for (std::size_t k = 0; k < shared.size(); ++k) {
        for (; next != missing.end() && *next <= passes[k].points.last; ++next) {
            if (*next >= passes[k].points.first) shared[k].push_back(nearest_end(passes[k], *next));
        }
        std::sort(shared[k].begin(), shared[k].end());
        shared[k].erase(std::unique(shared[k].begin(), shared[k].end()), shared[k].end());
    }
    return shared;
}

}  // namespace clsurf

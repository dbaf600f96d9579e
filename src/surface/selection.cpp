#include "surface/selection.h"

#include <algorithm>

namespace clsurf {
namespace {

Passes cut_at(const Passes& passes, const std::vector<PointRange>& ranges) {
    Passes pieces;
    std::size_t next = 0;
    for (const Pass& pass : passes) {
        PointIndex at = pass.first;
        for (; next < ranges.size() && ranges[next].first <= pass.last; ++next) {
            const PointIndex first = std::max(at, ranges[next].first);
            const PointIndex last = std::min(pass.last, ranges[next].last);
            if (first > at) pieces.push_back({at, first - 1, PassKind::rapid});
            pieces.push_back({first, last, pass.kind});
            at = last + 1;
            if (ranges[next].last > pass.last) break;  // continues in the next pass
        }
        if (at <= pass.last) pieces.push_back({at, pass.last, PassKind::rapid});
    }
    return pieces;
}

}  // namespace

void keep_points(ClSurface& surface, const std::vector<PointRange>& ranges) {
    const auto count = static_cast<std::size_t>(surface.positions.size());
    std::vector<char> kept(count, 0);
    for (const PointRange& range : ranges)
        std::fill(kept.begin() + range.first, kept.begin() + range.last + 1, char{1});
    for (Column<std::int32_t>* side : {&surface.neighbours.left, &surface.neighbours.right}) {
        for (std::size_t i = 0; i < side->size(); ++i) {
            std::int32_t& difference = (*side)[i];
            if (difference == Adjacency::none) continue;
            const auto neighbour = static_cast<std::size_t>(static_cast<std::int64_t>(i) + difference);
            if (kept[i] == 0 || kept[neighbour] == 0) difference = Adjacency::none;
        }
    }
    surface.passes = cut_at(surface.passes, ranges);
    surface.step_over_moves = intersection(surface.step_over_moves, ranges);  // those outside would be links again
}

std::vector<PointRange> intersection(const std::vector<PointRange>& a, const std::vector<PointRange>& b) {
    std::vector<PointRange> both;
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        const PointRange common{std::max(a[i].first, b[k].first), std::min(a[i].last, b[k].last)};
        if (common.size() > 0) both.push_back(common);
        if (a[i].last < b[k].last)
            ++i;
        else
            ++k;
    }
    return both;
}

std::vector<PointRange> points_of_passes(const Passes& passes, std::int64_t first, std::int64_t last) {
    std::vector<PointRange> points;
    std::int64_t number = 0;
    for (const Pass& pass : passes) {
        if (pass.kind != PassKind::cut) continue;
        ++number;
        if (number >= first && number <= last) points.push_back({pass.first, pass.last});
    }
    return points;
}

}  // namespace clsurf

#include "surface/path_location.h"

namespace clsurf {
namespace {

constexpr int farthest_walk = 8;  ///< points from the adjacency's neighbour to the crossing

/// Whether a point belongs to a cutting pass. Nearly all that do have a neighbour, so the passes are searched only
/// for the rest.
bool cuts(const ClSurface& surface, PointIndex point) {
    const Adjacency& neighbours = surface.neighbours;
    return neighbours.has(Side::left, point) || neighbours.has(Side::right, point) ||
           surface.passes[pass_of(surface.passes, point)].kind == PassKind::cut;
}

}  // namespace

PathLocation adjacent_location(const ClSurface& surface, const PathLocation& from, const Eigen::Vector3f& feed,
                               Side side) {
    const PointIndex own = from.nearest();
    if (!surface.neighbours.has(side, own)) return {};
    const Positions& p = surface.positions;
    const Eigen::Vector3f here = position_at(p, from);
    const auto along = [&](PointIndex k) { return (p[k] - here).dot(feed); };
    PointIndex k = surface.neighbours.neighbour(side, own);
    float at = along(k);
    if (at == 0) return {k, 0};
    // Towards the plane: the adjacent pass runs along or against the feed. It ends at a link or a rapid, because a
    // lift in the plane would be as near to it as the pass is.
    const auto goes_on = [&](PointIndex next) { return next >= 0 && next < p.size() && cuts(surface, next); };
    int direction = +1;
    if (!goes_on(k + 1) || (goes_on(k - 1) && std::abs(along(k - 1)) < std::abs(along(k + 1)))) direction = -1;
    for (int walked = 0; walked < farthest_walk; ++walked) {
        const PointIndex next = k + direction;
        if (!goes_on(next)) break;
        const float then = along(next);
        if (!(then == then)) return {};
        if (at * then <= 0) {
            const float share = at / (at - then);
            return direction > 0 ? PathLocation{k, share} : PathLocation{next, 1 - share};
        }
        if (std::abs(then) > std::abs(at)) break;
        k = next;
        at = then;
    }
    // At rest, or at the end of the pass: the nearest point is the best one.
    return {k, 0};
}

PathLocation beyond(const ClSurface& surface, const PathLocation& before, const PathLocation& from,
                    const Eigen::Vector3f& feed) {
    const PointIndex own = from.nearest();
    const Positions& p = surface.positions;
    const Eigen::Vector3f across = p[own] - position_at(p, before);
    for (const Side side : {Side::left, Side::right}) {
        if (!surface.neighbours.has(side, own)) continue;
        const Eigen::Vector3f on = p[surface.neighbours.neighbour(side, own)] - p[own];
        if (on.dot(across) > 0) return adjacent_location(surface, from, feed, side);
    }
    return {};
}

}  // namespace clsurf

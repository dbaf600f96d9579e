#include "surface/missing_pass.h"

namespace clsurf {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr float missing_width = 1.7F;  ///< width of a gap with a missing pass, in widths of the adjacent gaps

}  // namespace

bool misses_pass(const ClSurface& surface, PointIndex point, Side side) {
    const Positions& p = surface.positions;
    const PointIndex m = surface.neighbours.neighbour(side, point);
    const Vec3f gap = p[m] - p[point];
    if (gap.norm() < missing_width * static_cast<float>(surface.step_over)) return false;
    const Side other = side == Side::left ? Side::right : Side::left;
    if (!surface.neighbours.has(other, point)) return false;
    const Vec3f own = p[surface.neighbours.neighbour(other, point)] - p[point];
    for (const Side beyond : {Side::left, Side::right}) {
        if (!surface.neighbours.has(beyond, m)) continue;
        const Vec3f next = p[surface.neighbours.neighbour(beyond, m)] - p[m];
        if (next.dot(gap) <= 0) continue;  // use the neighbour on the far side
        constexpr float much = missing_width * missing_width;
        return gap.squaredNorm() > much * own.norm() * next.norm() &&
               gap.head<2>().squaredNorm() > much * own.head<2>().norm() * next.head<2>().norm();
    }
    return false;
}

}  // namespace clsurf

#include "toolpath/positions.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/block.h"

namespace clsurf {
namespace {

/// [mm] No tool is ever a kilometre from the first point; grids that span such distances would put all nearby points
/// into one cell.
constexpr double farthest_apart = 1e6;

Vec3 first_finite(const Trajectory& trajectory) {
    std::array<double, 256> x, y, z;
    for (PointIndex begin = 0; begin < trajectory.count; begin += 256) {
        const auto n = static_cast<std::size_t>(std::min<PointIndex>(256, trajectory.count - begin));
        trajectory.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            if (p.allFinite()) return p;
        }
    }
    return Vec3::Zero();
}

/// The target columns.
using GatheredColumns = std::array<float*, 3>;

void gather_block(const Trajectory& trajectory, const Vec3& from, const GatheredColumns& columns, PointIndex first,
                  PointIndex last) {
    // A quarter of a block at a time: the three axes of a record share its cache lines, which must still be in the
    // cache when the second and third axis are gathered.
    constexpr PointIndex step = 2048;
    std::array<std::array<double, step>, 3> scratch;
    for (PointIndex begin = first; begin < last; begin += step) {
        const auto n = static_cast<std::size_t>(std::min(step, last - begin));
        trajectory.read(begin, {scratch[0].data(), n}, {scratch[1].data(), n}, {scratch[2].data(), n});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float* out = columns[axis] + begin;
            const double origin = from[static_cast<Eigen::Index>(axis)];
            for (std::size_t i = 0; i < n; ++i) {
                const double d = scratch[axis][i] - origin;
                out[i] =
                    std::abs(d) <= farthest_apart ? static_cast<float>(d) : std::numeric_limits<float>::quiet_NaN();
            }
        }
    }
}

}  // namespace

void Positions::forget() {
    if (!fill) return;
    fill->forget();
    for (Column<float>* const axis : {&x, &y, &z}) axis->forget();
}

Trajectory trajectory_of(const Positions& positions) {
    Trajectory path;
    path.axes = {view_of(positions.x), view_of(positions.y), view_of(positions.z)};
    path.offset = positions.origin;
    path.count = positions.size();
    return path;
}

Positions gather(const Trajectory& trajectory) {
    Positions positions;
    positions.origin = first_finite(trajectory);
    for (Column<float>* column : {&positions.x, &positions.y, &positions.z})
        column->resize(static_cast<std::size_t>(trajectory.count));
    const GatheredColumns columns{positions.x.data(), positions.y.data(), positions.z.data()};
    for_each_block(trajectory.count, [&](PointIndex first, PointIndex last) {
        gather_block(trajectory, positions.origin, columns, first, last);
    });
    return positions;
}

Positions gather_when_read(const Trajectory& trajectory, const Vec3& origin, Column<double> arc_lengths,
                           PointIndex block) {
    Positions positions;
    positions.origin = origin;
    positions.arc_lengths = std::move(arc_lengths);
    for (Column<float>* column : {&positions.x, &positions.y, &positions.z})
        *column = Column<float>::sparse(static_cast<std::size_t>(trajectory.count));
    const GatheredColumns columns{positions.x.data(), positions.y.data(), positions.z.data()};
    positions.fill = {trajectory.count,
                      [trajectory, origin, columns](PointIndex first, PointIndex last) {
                          gather_block(trajectory, origin, columns, first, last);
                      },
                      block};
    return positions;
}

}  // namespace clsurf

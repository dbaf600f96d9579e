#pragma once
// Surfaces made for tests: zigzag passes over a plane at known speeds, with measured positions.

#include <functional>
#include <memory>
#include <vector>

#include "predictor/signals.h"
#include "surface/smoothing_segments.h"

namespace clsurf::test {

/// A log in memory, its trajectories and its surface.
struct MadeSurface {
    std::shared_ptr<std::vector<double>> columns;  ///< commanded x y z, measured x y z, one after the other
    Trajectory path, measured;
    bool has_measured = false;
    Passes passes;
    ClSurface surface;

    [[nodiscard]] Signals signals() const {
        std::vector<PointRange> pieces;
        for (const Pass& pass : surface.passes) pieces.push_back({pass.first, pass.last});
        return derive_signals(surface, path, has_measured ? &measured : nullptr, pieces, 1.0);
    }
};

/// The measured position for a commanded one; empty: no measured positions.
using Measure = std::function<Vec3(const Vec3& commanded, const Vec3& feed)>;

/// The true position of points of the plane: a rotation, a curved surface; empty: on the plane. Keeps distances.
using Place = std::function<Vec3(const Vec3& flat)>;

/// A surface from commanded and measured positions, one per millisecond, in passes `apart` mm from each other.
inline MadeSurface made_along(const std::vector<Vec3>& points, const std::vector<Vec3>& off, const Passes& passes,
                              double apart) {
    constexpr double period = 0.001;
    MadeSurface made;
    made.passes = passes;
    const std::size_t n = points.size();
    made.columns = std::make_shared<std::vector<double>>(6 * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            (*made.columns)[axis * n + i] = points[i][static_cast<Eigen::Index>(axis)];
            (*made.columns)[(3 + axis) * n + i] = off[i][static_cast<Eigen::Index>(axis)];
        }
    }
    const auto trajectory = [&](Role role, std::size_t column) {
        Trajectory t;
        t.role = role;
        t.count = static_cast<PointIndex>(n);
        t.period = period;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double* first = made.columns->data() + (column + axis) * n;
            t.axes[axis] = ChannelView{
                reinterpret_cast<const std::byte*>(first), sizeof(double), t.count, ScalarType::f64, false, 1.0, 0.0};
        }
        return t;
    };
    made.path = trajectory(Role::commanded, 0);
    made.measured = trajectory(Role::feedback, 3);
    made.surface.positions = gather(made.path);
    made.surface.passes = made.passes;
    made.surface.step_over = apart;
    made.surface.neighbours =
        find_neighbours(made.surface.positions, made.passes, ArcLength(made.surface.positions), apart);
    return made;
}

inline MadeSurface made_zigzag(const std::vector<double>& speeds, double length, double apart, const Measure& measure,
                               const Place& place = {}) {
    constexpr double period = 0.001;
    std::vector<Vec3> points;
    std::vector<Vec3> off;
    Passes passes;
    const auto add = [&](const Vec3& flat, const Vec3& feed) {
        const Vec3 p = place ? place(flat) : flat;
        points.push_back(p);
        off.push_back(measure ? measure(p, feed) : p);
    };
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        const double y = static_cast<double>(k) * apart;
        const bool forth = k % 2 == 0;
        const Vec3 feed(forth ? 1 : -1, 0, 0);
        const auto first = static_cast<PointIndex>(points.size());
        for (double s = 0; s <= length; s += speeds[k] * period) add(Vec3(forth ? s : length - s, y, 0), feed);
        passes.push_back({first, static_cast<PointIndex>(points.size()) - 1, PassKind::cut});
        if (k + 1 == speeds.size()) break;
        const auto link = static_cast<PointIndex>(points.size());
        for (int i = 1; i < 10; ++i) add(Vec3(forth ? length : 0, y + apart * i / 10, 0), Vec3(0, 1, 0));
        passes.push_back({link, static_cast<PointIndex>(points.size()) - 1, PassKind::link});
    }
    MadeSurface made = made_along(points, off, passes, apart);
    made.has_measured = static_cast<bool>(measure);
    return made;
}

inline MadeSurface flat_zigzag(int passes, double length, double apart, double speed, const Measure& measure,
                               const Place& place = {}) {
    return made_zigzag(std::vector<double>(static_cast<std::size_t>(passes), speed), length, apart, measure, place);
}

inline MadeSurface zigzag_of_speeds(const std::vector<double>& speeds, double length, double apart) {
    return made_zigzag(speeds, length, apart, {});
}

}  // namespace clsurf::test

#include "limits/path_tolerance.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"

namespace clsurf {
namespace {

/// A kernel may report one line for many merged lines, or be ahead on short lines. LinuxCNC joins up to 101 lines
/// (docs/simulate.md#the-trapezoidal-planner).
constexpr std::int64_t reach = 128;  ///< motions to each side

}  // namespace

PathTolerance::PathTolerance(const Trajectory& path, const Program& program, const LineMap& lines, PointIndex lead,
                             std::optional<double> own)
    : path_(&path),
      program_(&program),
      lines_(&lines),
      lead_(lead),
      toolpath_(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero()),
      least_(infinite) {
    const double machines_own = own.value_or(infinite);
    double tolerance = machines_own;
    auto event = program.events.begin();
    tolerances_.reserve(static_cast<std::size_t>(program.motions.size()));
    for (std::int64_t motion = 0; motion < program.motions.size(); ++motion) {
        for (; event != program.events.end() && event->motion <= motion; ++event) {
            const PathMode* const mode = event->path_mode();
            if (mode == nullptr) continue;
            tolerance = mode->block_end == BlockEnd::rounded ? mode->tolerance : infinite;
            if (std::isnan(tolerance)) tolerance = machines_own;
        }
        const double held = cuts(motion) ? tolerance : infinite;
        tolerances_.push_back(static_cast<float>(held));
        least_ = std::min(least_, held);
    }
    any_ = least_ < infinite;
}

bool PathTolerance::cuts(std::int64_t motion) const {
    const MotionKind kind = program_->motions.kind[static_cast<std::size_t>(motion)];
    return kind == MotionKind::feed || is_curved(kind);
}

double PathTolerance::tolerance_at(std::int64_t motion) const {
    const double here = tolerances_[static_cast<std::size_t>(motion)];
    return motion == 0 ? here : std::max<double>(here, tolerances_[static_cast<std::size_t>(motion - 1)]);
}

PathTolerance::Nearest PathTolerance::nearest(const Vec3& position, std::int64_t first, std::int64_t last) const {
    Nearest found{-1, infinite};
    for (std::int64_t motion = first; motion <= last; ++motion) {
        const double distance = toolpath_.projection(motion, position).distance;
        if (distance < found.distance) found = {motion, distance};
    }
    return found;
}

std::vector<PathDeviation> PathTolerance::read(PointRange records) const {
    const auto n = static_cast<std::size_t>(records.size());
    std::vector<PathDeviation> deviations(n, {missing<double>, infinite});
    std::vector<double> x(n), y(n), z(n);
    path_->read(records.first, x, y, z);
    const std::int64_t count = toolpath_.size();
    const auto near = [&](const Vec3& position, std::int64_t motion, std::int64_t behind, std::int64_t ahead) {
        return nearest(position, std::max<std::int64_t>(0, motion - behind), std::min(count - 1, motion + ahead));
    };
    std::int64_t cursor = -1;  // motion of the previous record
    for (std::size_t i = 0; i < n; ++i) {
        const PointIndex point = records.first + static_cast<PointIndex>(i);
        const std::int64_t motion = lines_->motion_at(std::max<PointIndex>(0, point - lead_));
        if (motion < 0 || !cuts(motion)) continue;
        const Vec3 position(x[i], y[i], z[i]);
        Nearest found = near(position, motion, 1, 1);
        if (found.distance > least_ && std::abs(cursor - motion) <= reach) {
            const Nearest here = near(position, cursor, 1, 2);
            if (here.distance < found.distance) found = here;
        }
        if (found.distance > least_) found = near(position, motion, reach, reach);
        cursor = found.motion;
        // Rapids may follow another path, and so may blends into them.
        if (found.motion < 0 || !cuts(found.motion)) continue;
        if (found.motion > 0 && !cuts(found.motion - 1) && found.distance > least_) continue;
        deviations[i] = {found.distance, tolerance_at(found.motion)};
    }
    return deviations;
}

}  // namespace clsurf

#pragma once
// Paths as points at equal distances along them, and the matching of points of a log with points of its program.
// Distances between points of the same path identify them, for any position and orientation of the log.

#include <vector>

#include "toolpath/toolpath.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Points at equal distances along a path.
struct PathProfile {
    double spacing = 0;  ///< [mm]
    std::vector<Vec3> points;

    [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The programmed path from the first motion whose start is known. O(motions).
[[nodiscard]] PathProfile profile_of(const Toolpath& path, std::size_t most_points);
/// The path of a log; steps below its noise are skipped. O(records).
[[nodiscard]] PathProfile profile_of(const Trajectory& path, double spacing);

/// A point of the log and the corresponding point of the program.
struct PointPair {
    Vec3 log, program;
};

/// Poses, rotation about Z and shift, that bring a log with this profile near the program, best first. Each is
/// determined by pairs that follow both paths in order. O(points of the program).
[[nodiscard]] std::vector<Eigen::Isometry3d> guess_poses(const PathProfile& program, const PathProfile& log);

/// The rotation about Z and shift that bring the points of a log onto those of the program: least squares in a few
/// rounds, each excluding the farthest fifth. Kabsch, Acta Crystallographica A32 (1976) 922, in the plane.
[[nodiscard]] Eigen::Isometry3d pose_of_pairs(const std::vector<PointPair>& pairs);

}  // namespace clsurf

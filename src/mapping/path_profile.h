#pragma once
// Paths as points at equal distances along them, and which point of a log is which of its program, wherever the log lies
// and however it is turned: distances between points of the same path say so.

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
/// The way of a log; steps below what its noise makes do not count. O(records).
[[nodiscard]] PathProfile profile_of(const Trajectory& path, double spacing);

/// A point of the log and the one of the program that it is.
struct PointPair {
    Vec3 log, program;
};

/// Poses, rotation about Z and shift, that bring a log with this profile near the program: the best first. Each is
/// settled by pairs that follow both paths in order. O(points of the program).
[[nodiscard]] std::vector<Eigen::Isometry3d> guess_poses(const PathProfile& program, const PathProfile& log);

/// The rotation about Z and shift that bring the points of a log onto those of the program: least squares, the farthest
/// fifth left out in each of a few rounds. Kabsch, Acta Crystallographica A32 (1976) 922, in the plane.
[[nodiscard]] Eigen::Isometry3d pose_of_pairs(const std::vector<PointPair>& pairs);

}  // namespace clsurf

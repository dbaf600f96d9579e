#pragma once
// The pose of a log: the shift and the rotation about Z that align its positions with the programmed path, if the log
// does not give them (an unknown work offset, a rotated work system, a tool length along Z).
//
// Initial guesses come from the places at which the reported line changes (the end of a programmed line); without lines,
// or if those are not informative, from the order of both paths (path_profile.h), and from the corners of the two
// bounding boxes. Each guess is refined by robust least squares of the distances to the nearest motions, which give no
// information along their direction (iterative closest point: Chen, Medioni 1992).

#include <string>
#include <vector>

#include "mapping/line_map.h"

namespace clsurf {

/// The poses that bring at least 90 % of the sampled moving points onto the path, within 0.05 mm and twice the
/// program's corner tolerance, and half of them within 0.05 mm. Several if they fit equally well (half a raster of
/// equal passes fits at either end); none for a path that determines none (one straight line). `map`: lines of the log
/// if it reports them, else nullptr. O(records + motions).
[[nodiscard]] std::vector<Eigen::Isometry3d> find_poses(const Trajectory& path, const Program& program,
                                                        const LineMap* map);

/// A pose in words: "12.5,-3,0" or "12.5,-3,0,17.5", as in --work-offset: machine = pose · workpiece.
[[nodiscard]] std::string pose_numbers(const Eigen::Isometry3d& pose);

/// If find_poses() finds a pose other than the identity: a warning `map.work-offset` with the option that applies it;
/// if it finds several, with all of them. Returns whether it did.
bool note_pose(const Trajectory& path, const Program& program, const LineMap* map, Diagnostics& diagnostics);

/// Share of sampled moving points that are near the path (within the distances of find_poses()) without a change of
/// pose, 0 … 1.
[[nodiscard]] double share_on_path(const Trajectory& path, const Program& program);

}  // namespace clsurf

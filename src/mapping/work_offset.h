#pragma once
// The pose of a log: the shift and the rotation about Z that lay its positions onto the programmed path, where the log
// does not tell them (an unknown work offset, a turned work system, a tool length along Z).
//
// First guesses come from the places where the reported line changes (the end of a programmed line); without lines, or
// where those say nothing, from the order of both paths (path_profile.h), and from the corners of the two bounding
// boxes. Each guess is refined by robust least squares of the distances to the nearest motions, along whose direction
// nothing is learned (iterative closest point: Chen, Medioni 1992).

#include <string>
#include <vector>

#include "mapping/line_map.h"

namespace clsurf {

/// What must be done to the positions: the poses that bring at least 90 % of the sampled moving points onto the path,
/// within 0.05 mm and twice the program's corner tolerance, half of them within 0.05 mm. Several where they fit alike
/// (half a raster of passes that are all alike fits at either end); none for a path that determines none (one straight
/// line). `map`: lines of the log where it reports them, nullptr without. O(records + motions).
[[nodiscard]] std::vector<Eigen::Isometry3d> find_poses(const Trajectory& path, const Program& program,
                                                        const LineMap* map);

/// A pose in words: "12.5,-3,0" or "12.5,-3,0,17.5", as --work-offset takes machine = pose · workpiece.
[[nodiscard]] std::string pose_numbers(const Eigen::Isometry3d& pose);

/// Where find_poses() finds one other than none: a warning `map.work-offset` with the option that brings the log there;
/// where it finds several, with all of them. True where it did.
bool note_pose(const Trajectory& path, const Program& program, const LineMap* map, Diagnostics& diagnostics);

/// Share of sampled moving points within reach of the path (as find_poses() has it) where they are, 0 … 1.
[[nodiscard]] double share_on_path(const Trajectory& path, const Program& program);

}  // namespace clsurf

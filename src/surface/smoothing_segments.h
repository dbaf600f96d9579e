#pragma once
// Pieces: the sections of a trajectory within which its points may be smoothed together. A window across a link or a
// gap in time would give speeds that the tool never had.

#include <memory>
#include <vector>

#include "log/log.h"
#include "surface/passes.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Passes in order, with neighbouring turns of a spiral as one piece, cut at missing records. O(points) if the log
/// has a time channel, else O(passes).
[[nodiscard]] std::vector<PointRange> smoothing_segments(const Log& log, const Passes& passes);

/// The same, cut at standstills that last at least a derivative's window and three records: a window that extended from there
/// into the motion would show speed before it begins. The records at rest are pieces of their own. The first and the last of
/// them also bound the adjacent motions, so that these begin and end at zero speed. O(points / window), parallel.
[[nodiscard]] std::vector<PointRange> split_at_standstills(const std::vector<PointRange>& pieces,
                                                           const Trajectory& path);

/// The estimator of speeds for `method`, in pieces that end at standstills; nullptr: savgol. `log` and `path` must outlive
/// it. O(points).
[[nodiscard]] std::shared_ptr<const MotionEstimate> estimate_motion(DerivativeMethod method, const Log& log,
                                                                    const Trajectory& path, const Passes& passes);

}  // namespace clsurf

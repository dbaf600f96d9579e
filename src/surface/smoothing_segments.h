#pragma once
// Pieces: the sections of a trajectory over which its points may be smoothed together. A window across a link
// or a gap in time would give speeds that the tool never had.

#include <memory>
#include <vector>

#include "log/log.h"
#include "surface/passes.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Passes in order, neighbouring turns of a spiral as one piece, cut where records are missing.
/// O(points) where the log has a time channel, O(passes) otherwise.
[[nodiscard]] std::vector<PointRange> smoothing_segments(const Log& log, const Passes& passes);

/// The same cut where the tool stands, at least as long as a derivative's window and for three records: a window that reached from
/// there into the motion would show speed before it begins. The records that stand are pieces of their own; the first and the last of
/// them bound the motions, whose speed is then that at their ends. O(points / window), parallel.
[[nodiscard]] std::vector<PointRange> split_at_standstills(const std::vector<PointRange>& pieces,
                                                           const Trajectory& path);

/// What derives speeds of passes as `method` asks, in pieces that end at standstills; nullptr: savgol. `log` and `path` must
/// outlive it. O(points).
[[nodiscard]] std::shared_ptr<const MotionEstimate> estimate_motion(DerivativeMethod method, const Log& log,
                                                                    const Trajectory& path, const Passes& passes);

}  // namespace clsurf

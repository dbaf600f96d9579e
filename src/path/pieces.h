#pragma once
// Pieces: the stretches of a trajectory over which its points may be smoothed together. A window that
// reached across a link or a gap in time would invent speeds that the tool never had.

#include <vector>

#include "log/log.h"
#include "path/passes.h"

namespace clsurf {

/// Passes in order, neighbouring turns of a spiral as one piece, cut where records are missing.
/// O(points) where the log has a time channel, O(passes) otherwise.
[[nodiscard]] std::vector<PointRange> smooth_pieces(const Log& log, const Passes& passes);

}  // namespace clsurf

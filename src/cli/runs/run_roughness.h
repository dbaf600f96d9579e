#pragma once
// The roughness of two runs in `diff`.

#include <optional>

#include "cli/runs/runs.h"
#include "pipeline/roughness_gauge.h"

namespace clsurf::cli {

/// `b`: the compared positions of `run`. Nothing: as in roughness_change(). Stitches the surface of `run`. O(points).
[[nodiscard]] std::optional<RoughnessChange> roughness_change_of(const GaugedRun& reference, LoadedRun& run,
                                                                 const ComparedRun& b, const CuttingTool& tool,
                                                                 const RunOptions& options);

}  // namespace clsurf::cli

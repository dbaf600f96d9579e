#pragma once
// The roughness that two runs of `diff` leave.

#include <optional>

#include "cli/runs/runs.h"
#include "pipeline/roughness_gauge.h"

namespace clsurf::cli {

/// `b`: how `run` is compared. Nothing: as roughness_change() has it. Stitches the surface of `run`. O(points).
[[nodiscard]] std::optional<RoughnessChange> roughness_change_of(const GaugedRun& reference, LoadedRun& run,
                                                                 const ComparedRun& b, const CuttingTool& tool,
                                                                 const RunOptions& options);

}  // namespace clsurf::cli

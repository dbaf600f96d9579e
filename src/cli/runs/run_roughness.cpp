#include "cli/runs/run_roughness.h"

#include <memory>

#include "mapping/map_lines.h"
#include "surface/stitch.h"

namespace clsurf::cli {
namespace {

/// The lines of the points of a run, as far as they determine which passes cut: --program may be the program of only the
/// reference.
std::unique_ptr<LineMap> lines_of_cuts(LoadedRun& run, const Trajectory& path, const RunOptions& options) {
    RunOptions any = options;
    any.force = true;
    Diagnostics reference_diagnostics;
    std::unique_ptr<LineMap> lines = lines_of(run, path, any, reference_diagnostics);
    if (!run.simulated && !lines->match().foreign.empty())
        lines = std::make_unique<LineMap>(lines_without_program(run.log, path.count));
    return lines;
}

}  // namespace

std::optional<RoughnessChange> roughness_change_of(const GaugedRun& reference, LoadedRun& run, const ComparedRun& b,
                                                   const CuttingTool& tool, const RunOptions& options) {
    const std::unique_ptr<LineMap> lines = lines_of_cuts(run, b.path, options);
    const ClSurface surface = stitch(gather(b.path), *lines);
    Trajectory path = b.path;
    state_tool_axes(path, run, *lines, nullptr);
    return roughness_change(reference, {run.log, path, *lines, surface}, tool);
}

}  // namespace clsurf::cli

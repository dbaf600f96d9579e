#pragma once
// ReferenceRun: the run with which other runs of the part are compared, one after another: where they differ, how rough their
// surfaces are, which of them drifted. The comparison of two runs itself is in the room compare.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/drifted_run.h"
#include "compare/run_report.h"
#include "pipeline/placed_run.h"
#include "pipeline/roughness_gauge.h"
#include "pipeline/stages.h"

namespace clsurf {

struct ComparisonRules {
    PlacingRules placing;      ///< of the lines of the runs
    std::optional<Role> role;  ///< positions by which runs are compared; nullopt: common_role() chooses
    /// Finds the tool of the reference, once its program (nullptr: not known) is read. Empty: it is that of the placed run.
    /// Without a tool, places are tool tips, and there is no roughness.
    std::function<std::optional<CuttingTool>(const Log&, const Program*, Diagnostics&)> tool_of;
    bool with_roughness = false;
    /// What the user can do about runs that cannot be compared: hints of the errors.
    std::string other_roles_hint = {}, other_path_hint = {};
};

/// A run, compared with the reference.
struct ComparedWithReference {
    RunDifferences differences;                ///< at the points of the reference
    RunReport report;                          ///< at contact points if the tool is known
    std::optional<RoughnessChange> roughness;  ///< if it is requested and known
};

/// Not movable.
class ReferenceRun {
public:
    explicit ReferenceRun(PlacedRun run, ComparisonRules rules = {}) : run_(std::move(run)), rules_(std::move(rules)) {}
    ReferenceRun(const ReferenceRun&) = delete;
    ReferenceRun& operator=(const ReferenceRun&) = delete;

    /// Compares another run. The first one determines by which positions all are compared; `diagnostics` then gets those of
    /// the reference's lines and tool. Throws InputError: no common positions, or others than those of the runs before it;
    /// no part of it is on the path of the reference; what lines_of() throws. O(points of both).
    [[nodiscard]] ComparedWithReference compare(const PlacedRun& run, Diagnostics& diagnostics,
                                                const Stages& stages = {});

    /// Departures of the reference, and of the compared runs in their order, from the median run. Empty: fewer than two were
    /// compared. drifted_run() finds the one that drifted.
    [[nodiscard]] std::vector<RunDeparture> departures() const;

    [[nodiscard]] const PlacedRun& run() const { return run_; }
    /// Its positions, and the surface of them. Domain: a run was compared.
    [[nodiscard]] const Trajectory& path() const { return *run_.path; }
    [[nodiscard]] const ClSurface& surface() const { return surface_; }

private:
    void begin(Trajectory& path, Diagnostics& diagnostics, const Stages& stages);
    [[nodiscard]] std::optional<RoughnessChange> roughness_change_to(const PlacedRun& run, const ComparedRun& b) const;

    PlacedRun run_;
    ComparisonRules rules_;
    RunLines lines_;
    ClSurface surface_;
    std::optional<DriftFinder> drift_;  ///< nullopt: no run was compared yet
};

}  // namespace clsurf

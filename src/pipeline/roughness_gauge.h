#pragma once
// RoughnessGauge: the roughness that runs of a part leave, each measured at the same places and over the same form, those of
// the first run.

#include <memory>
#include <optional>
#include <vector>

#include "machined/part_roughness.h"
#include "machined/tool.h"
#include "pipeline/tool_run.h"

namespace clsurf {

/// A run whose roughness is measured, in the coordinates of the workpiece. Refers to its members.
struct GaugedRun {
    const Log& log;
    const Trajectory& path;  ///< commanded, or what the log has
    const LineMap& lines;
    const ClSurface& surface;               ///< of `path`
    const QualityReport* report = nullptr;  ///< whose programmed marks are no form; nullptr: all of the program is form
};

/// The roughness that two runs of a part leave.
struct RoughnessChange {
    PartRoughness before, after;

    /// Whether both are known somewhere.
    [[nodiscard]] bool is_known() const { return !before.patches.empty() && !after.patches.empty(); }
};

class RoughnessGauge {
public:
    /// `before` must outlive it. The tool is swept along the role's positions (none: the most truthful ones of each log).
    /// Throws UsageError as upright_part() does. O(points), parallel.
    RoughnessGauge(const GaugedRun& before, const CuttingTool& tool, std::optional<Role> role = std::nullopt);
    RoughnessGauge(const RoughnessGauge&) = delete;
    RoughnessGauge& operator=(const RoughnessGauge&) = delete;
    [[nodiscard]] const PartRoughness& before() const { return roughness_; }
    /// To another run of the part, of both at those places where both can be measured. O(points), parallel. Throws as the
    /// constructor does.
    [[nodiscard]] RoughnessChange change_to(const GaugedRun& after) const;

private:
    /// A run with what a tool is swept along.
    struct Swept {
        std::unique_ptr<const UprightPart>
            upright;  ///< of a tool that is tilted; then nothing was read of the run itself
        PartSignals read;
        GaugedRun of;
        [[nodiscard]] ToolRun run() const { return upright ? upright->run() : ToolRun{of.path, of.surface, read}; }
    };
    [[nodiscard]] Swept sweep(const GaugedRun& run) const;
    [[nodiscard]] AsMachinedSurface as_machined(const Swept& swept) const;
    [[nodiscard]] PartRoughness measure(const AsMachinedSurface& measured, const ToolRun& run) const;

    CuttingTool tool_;
    std::optional<Role> role_;
    Swept swept_;  ///< the first run
    AsMachinedSurface form_of_;
    std::vector<RoughnessPlace> places_;
    PartRoughness roughness_;
};

/// Both at those places of the first where both can be measured: a log may hold a part of the program only. The positions are of
/// a kind that both logs have: `role`, else the most truthful one. Nothing: a tool that is tilted and no ball, or a run without adjacent
/// passes. O(points), parallel.
[[nodiscard]] std::optional<RoughnessChange> roughness_change(const GaugedRun& before, const GaugedRun& after,
                                                              const CuttingTool& tool,
                                                              std::optional<Role> role = std::nullopt);

/// The same of parts. Nothing also where the tool is not known, or is not the same. `report_before`: the defects of the first
/// one; nullptr: they are looked for.
[[nodiscard]] std::optional<RoughnessChange> roughness_change(const Part& before, const ClSurface& surface_before,
                                                              const Part& after, const ClSurface& surface_after,
                                                              std::optional<Role> role = std::nullopt,
                                                              const QualityReport* report_before = nullptr);

}  // namespace clsurf

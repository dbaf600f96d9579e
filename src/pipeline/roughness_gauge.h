#pragma once
// RoughnessGauge: the roughness of runs of a part, measured at the places of the first run and relative to its form.

#include <memory>
#include <optional>
#include <vector>

#include "machined/part_roughness.h"
#include "machined/tool.h"
#include "pipeline/tool_run.h"

namespace clsurf {

/// A run whose roughness is measured, in the coordinates of the workpiece. Refers to data that must outlive it.
struct GaugedRun {
    const Log& log;
    const Trajectory& path;  ///< commanded, or what the log has
    const LineMap& lines;
    const ClSurface& surface;               ///< of `path`
    const QualityReport* report = nullptr;  ///< its programmed marks are not in the form; nullptr: they are
};

/// The roughness of two runs of a part.
struct RoughnessChange {
    PartRoughness before, after;

    /// Whether both values are known at some place.
    [[nodiscard]] bool is_known() const { return !before.patches.empty() && !after.patches.empty(); }
};

class RoughnessGauge {
public:
    /// `before` must outlive the object. The tool is swept along the positions of `role` (nullopt: as measured_role()
    /// chooses for each log). Throws UsageError as upright_part() does. O(points), parallel.
    RoughnessGauge(const GaugedRun& before, const CuttingTool& tool, std::optional<Role> role = std::nullopt);
    RoughnessGauge(const RoughnessGauge&) = delete;
    RoughnessGauge& operator=(const RoughnessGauge&) = delete;
    [[nodiscard]] const PartRoughness& before() const { return roughness_; }
    /// Compares with another run of the part, at the places where both can be measured. O(points), parallel. Throws as the
    /// constructor does.
    [[nodiscard]] RoughnessChange change_to(const GaugedRun& after) const;

private:
    /// A run with the data along which a tool is swept.
    struct Swept {
        std::unique_ptr<const UprightPart> upright;  ///< for a tilted tool; then nothing of the run itself was read
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

/// The roughness of both runs at the places of the first one where both can be measured: a log may contain only a part of
/// the program. Uses positions that both logs have: `role`, else as common_measured_role(). nullopt: a tilted tool that is
/// not a ball, or a run without adjacent passes. O(points), parallel.
[[nodiscard]] std::optional<RoughnessChange> roughness_change(const GaugedRun& before, const GaugedRun& after,
                                                              const CuttingTool& tool,
                                                              std::optional<Role> role = std::nullopt);

/// The same for parts. Also nullopt if the tool is unknown or not the same. `report_before`: the defects of the first one;
/// nullptr: they are computed.
[[nodiscard]] std::optional<RoughnessChange> roughness_change(const Part& before, const ClSurface& surface_before,
                                                              const Part& after, const ClSurface& surface_after,
                                                              std::optional<Role> role = std::nullopt,
                                                              const QualityReport* report_before = nullptr);

}  // namespace clsurf

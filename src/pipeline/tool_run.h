#pragma once
// ToolRun: the data along which a tool is swept, for an upright tool or an equivalent upright one.

#include <memory>
#include <optional>

#include "machined/as_machined_surface.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "predictor/defect.h"

namespace clsurf {

/// The data along which a tool is swept. Refers to its members, which must outlive it.
struct ToolRun {
    const Trajectory& path;
    const ClSurface& surface;
    const PartSignals& read;

    /// Sweeps along the measured positions if there are any. The programmed marks of `report` do not belong to the form;
    /// nullptr: the whole program is form. The result refers to the same data as this object.
    [[nodiscard]] AsMachinedSurface as_machined(const CuttingTool& tool, const QualityReport* report) const;
    /// Whether the log has commanded positions in addition to the measured ones.
    [[nodiscard]] bool has_both() const { return path.role == Role::commanded && read.measured.has_value(); }
    /// Sweeps along the path itself.
    [[nodiscard]] AsMachinedSurface as_commanded(const CuttingTool& tool) const;
};

/// The data of a part for an upright tool that cuts the same.
struct UprightPart {
    Trajectory path;
    ClSurface surface;
    PartSignals read;

    [[nodiscard]] ToolRun run() const { return {path, surface, read}; }
};

/// nullptr: the tool is always along z. If not, it must be a ball, whose centre is used; throws UsageError for other tools,
/// and if the axis is unknown.
[[nodiscard]] std::unique_ptr<const UprightPart> upright_part(const Log& log, const Trajectory& path,
                                                              const LineMap& lines, std::optional<Role> wanted,
                                                              const CuttingTool& tool);

}  // namespace clsurf

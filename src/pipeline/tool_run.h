#pragma once
// ToolRun: what a tool is swept along, upright or as an upright one that cuts the same.

#include <memory>
#include <optional>

#include "machined/as_machined_surface.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "predictor/defect.h"

namespace clsurf {

/// What a tool is swept along. Refers to its members, which must outlive it.
struct ToolRun {
    const Trajectory& path;
    const ClSurface& surface;
    const PartSignals& read;

    /// Swept along the measured positions, where there are such. The programmed marks of `report` are no form; nullptr: all of
    /// the program is form. Refers to what this refers to.
    [[nodiscard]] AsMachinedSurface as_machined(const CuttingTool& tool, const QualityReport* report) const;
    /// Whether the log has commanded positions besides those that are measured.
    [[nodiscard]] bool has_both() const { return path.role == Role::commanded && read.measured.has_value(); }
    /// Swept along the path itself.
    [[nodiscard]] AsMachinedSurface as_commanded(const CuttingTool& tool) const;
};

/// A part as an upright tool that cuts the same goes over it.
struct UprightPart {
    Trajectory path;
    ClSurface surface;
    PartSignals read;

    [[nodiscard]] ToolRun run() const { return {path, surface, read}; }
};

/// nullptr: the tool stands along z all the time. Else it must be a ball, whose centre is what counts; throws
/// UsageError for other tools, and where the axis is not known.
[[nodiscard]] std::unique_ptr<const UprightPart> upright_part(const Log& log, const Trajectory& path,
                                                              const LineMap& lines, std::optional<Role> wanted,
                                                              const CuttingTool& tool);

}  // namespace clsurf

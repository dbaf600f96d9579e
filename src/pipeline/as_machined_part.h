#pragma once
// AsMachinedPart: the surface that the tool leaves, swept along the positions of a part.

#include <memory>
#include <optional>

#include "machined/as_machined_surface.h"
#include "pipeline/part.h"
#include "pipeline/tool_run.h"
#include "predictor/defect.h"

namespace clsurf {

/// A formed surface with what it refers to; does not move once it is made.
class AsMachinedPart {
public:
    /// Sweeps `tool` along the role's positions (none: the most truthful ones of the log) of the part,
    /// whose path is the commanded one where the log has it. `report`: the defects of the part, whose programmed marks
    /// are no form; nullptr: they are looked for. Part and surface must outlive it. Throws UsageError as upright_part()
    /// does. O(points), parallel.
    AsMachinedPart(const Part& part, const ClSurface& surface, std::optional<Role> role, const CuttingTool& tool,
                   const QualityReport* report = nullptr);
    AsMachinedPart(const AsMachinedPart&) = delete;
    AsMachinedPart& operator=(const AsMachinedPart&) = delete;

    [[nodiscard]] const AsMachinedSurface& surface() const { return *as_machined_; }
    [[nodiscard]] const Signals& signals() const { return upright_ ? upright_->read.signals : read_.signals; }

private:
    std::unique_ptr<const UprightPart> upright_;  ///< of a tool that is tilted; then nothing is kept of the part itself
    PartSignals read_;
    std::optional<AsMachinedSurface> as_machined_;
};

}  // namespace clsurf

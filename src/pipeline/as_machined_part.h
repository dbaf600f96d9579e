#pragma once
// AsMachinedPart: the surface that the tool leaves, swept along the positions of a part.

#include <memory>
#include <optional>

#include "machined/as_machined_surface.h"
#include "pipeline/part.h"
#include "pipeline/tool_run.h"
#include "predictor/defect.h"

namespace clsurf {

/// An as-machined surface with the data that it refers to; not movable.
class AsMachinedPart {
public:
    /// Sweeps `tool` along the positions of `role` (nullopt: as measured_role() chooses). The path of the part
    /// is the commanded one if the log has it. `report`: the defects of the part, whose programmed marks do not belong to
    /// the form; nullptr: they are computed. Part and surface must outlive the object. Throws UsageError as upright_part()
    /// does. O(points), parallel.
    AsMachinedPart(const Part& part, const ClSurface& surface, std::optional<Role> role, const CuttingTool& tool,
                   const QualityReport* report = nullptr);
    AsMachinedPart(const AsMachinedPart&) = delete;
    AsMachinedPart& operator=(const AsMachinedPart&) = delete;

    [[nodiscard]] const AsMachinedSurface& surface() const { return *as_machined_; }
    [[nodiscard]] const Signals& signals() const { return upright_ ? upright_->read.signals : read_.signals; }

private:
    std::unique_ptr<const UprightPart> upright_;  ///< for a tilted tool; then nothing of the part itself is kept
    PartSignals read_;
    std::optional<AsMachinedSurface> as_machined_;
};

}  // namespace clsurf

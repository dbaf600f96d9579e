#pragma once
// RoughnessGauge: the roughness that runs of a part leave, each measured at the same places and over the same form, those of
// the program as it was.

#include <memory>
#include <vector>

#include "machined/part_roughness.h"
#include "machined/tool.h"
#include "pipeline/as_machined_part.h"
#include "repair/judged_run.h"

namespace clsurf {

class RoughnessGauge {
public:
    /// `before`, which must outlive it, is a run on three axes. O(points), parallel.
    RoughnessGauge(const JudgedRun& before, const CuttingTool& tool);
    [[nodiscard]] const PartRoughness& before() const { return roughness_; }
    /// Of a run of a changed program. O(points), parallel.
    [[nodiscard]] PartRoughness after(const JudgedRun& run) const;

private:
    [[nodiscard]] PartRoughness measure(const JudgedRun& run, const PartSignals& read) const;

    CuttingTool tool_;
    const JudgedRun& before_;
    PartSignals read_;
    AsMachinedSurface form_of_;
    std::vector<RoughnessPlace> places_;
    PartRoughness roughness_;
};

/// The measures of a run with its roughness, where that is known.
[[nodiscard]] RunMeasures with_roughness(RunMeasures measures, const PartRoughness& roughness);

}  // namespace clsurf

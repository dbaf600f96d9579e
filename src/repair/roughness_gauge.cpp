#include "repair/roughness_gauge.h"

#include <optional>

namespace clsurf {

RoughnessGauge::RoughnessGauge(const JudgedRun& before, const CuttingTool& tool)
    : tool_(tool),
      before_(before),
      read_(signals_along(before.log, before.path, before.surface)),
      form_of_(ToolRun{before.path, before.surface, read_}.as_machined(tool)),
      places_(roughness_places(form_of_, read_.signals)),
      roughness_(measure(before, read_)) {}

PartRoughness RoughnessGauge::after(const JudgedRun& run) const {
    return measure(run, signals_along(run.log, run.path, run.surface));
}

PartRoughness RoughnessGauge::measure(const JudgedRun& run, const PartSignals& read) const {
    const ToolRun swept{run.path, run.surface, read};
    const AsMachinedSurface measured = swept.as_machined(tool_);
    std::optional<AsMachinedSurface> commanded;
    if (swept.has_both()) commanded.emplace(swept.as_commanded(tool_));
    return measure_roughness({measured, form_of_, commanded ? &*commanded : nullptr}, places_);
}

RunMeasures with_roughness(RunMeasures measures, const PartRoughness& roughness) {
    if (!roughness.patches.empty()) measures.roughness = roughness.ra;
    return measures;
}

}  // namespace clsurf

#include "pipeline/roughness_gauge.h"

#include "pipeline/judge.h"
#include "pipeline/roles.h"
#include "pipeline/signals_of.h"

namespace clsurf {
namespace {

bool can_gauge(const GaugedRun& run, const CuttingTool& tool) {
    return run.surface.step_over > 0 && run.path.axis_known &&
           (tool.kind == ToolKind::ball || !tilts(run.log, run.path));
}

}  // namespace

RoughnessGauge::RoughnessGauge(const GaugedRun& before, const CuttingTool& tool, std::optional<Role> role)
    : tool_(tool),
      role_(role),
      swept_(sweep(before)),
      form_of_(as_machined(swept_)),
      places_(roughness_places(form_of_, swept_.run().read.signals)),
      roughness_(measure(form_of_, swept_.run())) {}

RoughnessChange RoughnessGauge::change_to(const GaugedRun& after) const {
    const Swept swept = sweep(after);
    RoughnessChange change{roughness_, measure(as_machined(swept), swept.run())};
    keep_common_patches(change.before, change.after);
    return change;
}

RoughnessGauge::Swept RoughnessGauge::sweep(const GaugedRun& run) const {
    Swept swept{upright_part(run.log, run.path, run.lines, role_, tool_), {}, run};
    if (!swept.upright) swept.read = signals_along(run.log, run.path, run.surface, role_);
    return swept;
}

AsMachinedSurface RoughnessGauge::as_machined(const Swept& swept) const {
    return swept.run().as_machined(tool_, swept.of.report);
}

PartRoughness RoughnessGauge::measure(const AsMachinedSurface& measured, const ToolRun& run) const {
    std::optional<AsMachinedSurface> commanded;
    if (run.has_both()) commanded.emplace(run.as_commanded(tool_));
    return measure_roughness({measured, form_of_, commanded ? &*commanded : nullptr}, places_);
}

std::optional<RoughnessChange> roughness_change(const GaugedRun& before, const GaugedRun& after,
                                                const CuttingTool& tool, std::optional<Role> role) {
    if (!can_gauge(before, tool) || !can_gauge(after, tool)) return std::nullopt;
    if (!role) role = common_measured_role(before.log, after.log).value_or(Role::commanded);
    return RoughnessGauge(before, tool, role).change_to(after);
}

std::optional<RoughnessChange> roughness_change(const Part& before, const ClSurface& surface_before, const Part& after,
                                                const ClSurface& surface_after, std::optional<Role> role,
                                                const QualityReport* report_before) {
    if (!after.tool || before.tool != after.tool) return std::nullopt;
    QualityReport found;
    if (report_before == nullptr) {
        found = find_defects(before, surface_before, signals_of(before, surface_before, role));
        report_before = &found;
    }
    return roughness_change({before.log, before.path, *before.lines, surface_before, report_before},
                            {after.log, after.path, *after.lines, surface_after}, *after.tool, role);
}

}  // namespace clsurf

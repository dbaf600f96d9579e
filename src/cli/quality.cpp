#include "cli/quality.h"

#include <algorithm>
#include <limits>

#include "cli/contacts.h"
#include "path/pieces.h"
#include "quality/axis_delay.h"
#include "quality/scallop.h"

namespace clsurf::cli {
namespace {

std::optional<Trajectory> measured_of(const Log& log, const Trajectory& path, std::optional<Role> wanted) {
    if (path.role != Role::commanded || wanted == Role::commanded) return std::nullopt;
    if (wanted) return reconstruct_like(log, *wanted, path);
    for (const Role role : {Role::actual, Role::feedback}) {
        if (can_reconstruct_like(log, role, path)) return reconstruct_like(log, role, path);
    }
    return std::nullopt;
}

PartSignals signals_along(const Log& log, const Trajectory& path, const ClSurface& surface,
                          std::optional<Role> wanted) {
    PartSignals result{measured_of(log, path, wanted), smooth_pieces(log, surface.passes), {}};
    result.signals = derive_signals(surface, path, result.measured ? &*result.measured : nullptr, result.pieces,
                                    usual_end_zone(surface.step_over));
    return result;
}

}  // namespace

std::optional<Role> take_measured_role(PartOptions& options) {
    if (!options.role_given) return std::nullopt;
    const Role role = options.role;
    options.role = Role::commanded;
    options.role_given = false;
    return role;
}

PartSignals signals_of(const Part& part, const ClSurface& surface, std::optional<Role> wanted) {
    return signals_along(part.log, part.path, surface, wanted);
}

FormedSurface ToolRun::formed(const CuttingTool& tool) const {
    return {surface, read.signals, path.role, read.swept(path), read.pieces, tool};
}

std::unique_ptr<const UprightPart> upright_part(const Part& part, std::optional<Role> wanted, const CuttingTool& tool) {
    if (!tilts(part.log, part.path)) return nullptr;
    if (tool.kind != ToolKind::ball) {
        throw UsageError(
            to_text(tool) +
                " is tilted: where a tool that is no ball touches, its axis decides, and only tools along z are known",
            "a ball-end tool may be tilted: --tool ball:D");
    }
    auto upright = std::make_unique<UprightPart>();
    upright->path = upright_ball(part.log, part.path, tool.radius);
    upright->surface = clsurf::stitch(gather(upright->path), *part.lines);
    upright->read = signals_along(part.log, upright->path, upright->surface, wanted);
    return upright;
}

QualityReport find_part_defects(Part& part, const ClSurface& surface, const PartSignals& read,
                                const QualityRules& rules, StageClock& clock) {
    clock.begin("find the defects");
    QualityReport report = find_defects(surface, read.signals, *part.lines, part.program, part.log.period, rules);
    for (std::string& doubt : part.lines->match().doubts()) report.judgement.refuse(std::move(doubt));
    if (read.measured) explain_systematic_lag(report, part.path, *read.measured, read.signals);
    for (const std::string& reason : report.judgement.reasons)
        part.diagnostics.add(
            {Severity::warning, "quality.not-judged", Place::of_file(part.log.name), "not judged: " + reason, {}});
    return report;
}

Quality judge(Part& part, const ClSurface& surface, std::optional<Role> wanted, const QualityRules& rules,
              StageClock& clock) {
    Quality quality;
    clock.begin("derive the signals");
    const PartSignals read = signals_of(part, surface, wanted);
    quality.report = find_part_defects(part, surface, read, rules, clock);
    if (!part.tool || surface.step_over <= 0) return quality;
    const CuttingTool tool = *part.tool;
    clock.begin("measure the formed surface");
    const PartContacts contacts(part, surface, tool);
    contacts.locate(quality.report);
    if (tool.kind != ToolKind::ball && tilts(part.log, part.path)) {
        part.diagnostics.add(
            {Severity::warning,
             "quality.tilted-tool",
             Place::of_file(part.log.name),
             to_text(tool) + " is tilted: the formed surface and its roughness are known of balls only",
             {}});
        return quality;
    }
    const std::unique_ptr<const UprightPart> upright = upright_part(part, wanted, tool);
    const ToolRun run = upright ? upright->run() : ToolRun{part.path, surface, read};
    const double step_over = run.surface.step_over;
    if (tool.kind == ToolKind::ball && step_over > 0 && step_over < 2 * tool.radius) {
        quality.scallop = scallop_height(tool.radius, step_over, std::numeric_limits<double>::infinity());
    }
    quality.formed = measure_formed(run.formed(tool), run.read.signals, quality.report);
    for (RoughPatch& patch : quality.formed->patches)
        patch.contact = contacts.place(patch.point).contact.value_or(patch.contact);
    return quality;
}

}  // namespace clsurf::cli

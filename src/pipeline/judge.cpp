#include "pipeline/judge.h"

#include <memory>
#include <string>
#include <utility>

#include "pipeline/contacts.h"
#include "pipeline/tool_run.h"
#include "predictor/axis_delay.h"
#include "predictor/quality_fields.h"

namespace clsurf {
namespace {

/// Roughness and scallops of the as-machined surface, and the places of its rough patches.
void measure_as_machined_surface(const Part& part, const ClSurface& surface, std::optional<Role> measured,
                                 const PartSignals& read, const PartContacts& contacts,
                                 const std::optional<FoundInShards>& found, Quality& quality) {
    const CuttingTool tool = *part.tool;
    const std::unique_ptr<const UprightPart> upright = upright_part(part.log, part.path, *part.lines, measured, tool);
    const ToolRun run = upright ? upright->run() : ToolRun{part.path, surface, read};
    const AsMachinedSurface measured_surface = run.as_machined(tool, &quality.report);
    std::optional<AsMachinedSurface> commanded;
    if (run.has_both()) commanded.emplace(run.as_commanded(tool));
    quality.as_machined =
        measure_as_machined(measured_surface, run.read.signals, quality.report, commanded ? &*commanded : nullptr,
                            found ? &found->scallops : nullptr, found ? found->forget : ForgetBlocks());
    quality.scallop = quality.as_machined->scallop;
    for (RoughPatch& patch : quality.as_machined->roughness.patches)
        patch.contact = contacts.place(patch.point).contact.value_or(patch.contact);
}

}  // namespace

QualityReport find_defects(const Part& part, const ClSurface& surface, const PartSignals& read,
                           const QualityRules& rules) {
    return find_defects(part, part.path, surface, read, rules);
}

QualityReport find_defects(const Part& part, const Trajectory& path, const ClSurface& surface, const PartSignals& read,
                           const QualityRules& rules) {
    QualityReport report = find_defects(surface, read.signals, *part.lines, part.program, part.log.period, rules);
    for (std::string& doubt : part.lines->match().doubts()) report.judgement.refuse(std::move(doubt));
    if (read.measured) explain_systematic_lag(report, path, *read.measured, read.signals);
    return report;
}

void note_reasons(const QualityReport& report, const Part& part, Diagnostics& diagnostics) {
    for (const std::string& reason : report.judgement.reasons) {
        diagnostics.add(
            {Severity::warning, "quality.not-judged", Place::of_file(part.log.name), "not judged: " + reason, {}});
    }
}

Quality judge(const Part& part, const ClSurface& surface, std::optional<Role> measured, const QualityRules& rules,
              const Stages& stages, bool with_motion) {
    begin_stage(stages, "derive the signals");
    const PartSignals read = signals_of(part, surface, measured);
    Quality quality = judge(part, surface, read, measured, rules, stages);
    if (with_motion)
        quality.motion = motion_quality(part.log, part.path, surface, speed_differences(surface, read.signals),
                                        estimate_motion(part, surface.passes));
    return quality;
}

Quality judge(const Part& part, const ClSurface& surface, const PartSignals& read, std::optional<Role> measured,
              const QualityRules& rules, const Stages& stages) {
    Quality quality;
    begin_stage(stages, "find the defects");
    quality.report = find_defects(part, surface, read, rules);
    note_reasons(quality.report, part, quality.diagnostics);
    if (!part.tool || surface.step_over <= 0) return quality;
    begin_stage(stages, "measure the as-machined surface");
    const PartContacts contacts(part, surface, *part.tool);
    contacts.locate(quality.report);
    if (!contacts.known()) {
        quality.diagnostics.add({Severity::warning, "quality.tool-axis", Place::of_file(part.log.name),
                                 "the axis of " + to_text(*part.tool) +
                                     " is not known: positions are those of tips, and there is no as-machined surface",
                                 "give the kinematics with --machine FILE"});
        return quality;
    }
    if (part.tool->kind != ToolKind::ball && tilts(part.log, part.path)) {
        quality.diagnostics.add(
            {Severity::warning,
             "quality.tilted-tool",
             Place::of_file(part.log.name),
             to_text(*part.tool) +
                 " is tilted: the as-machined surface and its roughness are available for ball-end tools only",
             {}});
        return quality;
    }
    measure_as_machined_surface(part, surface, measured, read, contacts, rules.found, quality);
    return quality;
}

}  // namespace clsurf

#include "pipeline/compare_runs.h"

#include <utility>

#include "core/error.h"
#include "pipeline/contacts.h"
#include "pipeline/roles.h"
#include "surface/stitch.h"

namespace clsurf {
namespace {

ComparedRun compared(const PlacedRun& run, const PlacedRun& other, std::optional<Role> wanted) {
    const Role role = required_common_role(run.log, other.log, wanted);
    ComparedRun made = compared_run(run.log, other.log, run.positions(role));
    made.derivative = run.derivative;
    return made;
}

/// The lines of a run, as far as they determine which passes cut: the program may be that of the reference only.
RunLines lines_of_cuts(const PlacedRun& run, const Trajectory& path, PlacingRules rules) {
    rules.accept_foreign = true;
    Diagnostics known_from_reference;
    RunLines lines = lines_of(run, path, rules, known_from_reference);
    if (!run.simulated && !lines.map->match().foreign.empty())
        lines.map = std::make_shared<const LineMap>(lines_without_program(run.log, path.count));
    return lines;
}

}  // namespace

/// What is known as soon as the positions of the reference are.
void ReferenceRun::begin(Trajectory& path, Diagnostics& diagnostics, const Stages& stages) {
    begin_stage(stages, "stitch the surface");
    lines_ = lines_of(run_, path, rules_.placing, diagnostics);
    surface_ = stitch(gather(path), *lines_.map);
    if (rules_.tool_of) run_.tool = rules_.tool_of(run_.log, lines_.program.get(), diagnostics);
    if (run_.tool) state_tool_axes(path, run_, lines_, &diagnostics);
    run_.path = path;  // its positions are not computed again
    drift_.emplace(surface_);
}

ComparedWithReference ReferenceRun::compare(const PlacedRun& run, Diagnostics& diagnostics, const Stages& stages) {
    ComparedRun a = compared(run_, run, rules_.role);
    const ComparedRun b = compared(run, run_, rules_.role);
    if (drift_ && a.path.role != run_.path->role)
        throw InputError(Place::of_file(run.name), "has other kinds of positions than the runs before it",
                         rules_.other_roles_hint);
    if (!drift_) begin(a.path, diagnostics, stages);
    begin_stage(stages, "compare the runs");
    ComparedWithReference found;
    found.differences = compare_runs(a, surface_, b);
    if (!(found.differences.alignment.aligned > 0))
        throw InputError(Place::of_file(run.name), "shares no path with " + run_.name, rules_.other_path_hint);
    found.report = report_run(a, surface_, lines_.known ? lines_.map.get() : nullptr, b, found.differences);
    if (run_.tool) PartContacts(run_.log, a.path, *lines_.map, surface_, *run_.tool).locate(found.report);
    if (run_.tool && rules_.with_roughness) {
        begin_stage(stages, "measure the roughness");
        found.roughness = roughness_change_to(run, b);
    }
    drift_->add(found.differences);
    return found;
}

std::optional<RoughnessChange> ReferenceRun::roughness_change_to(const PlacedRun& run, const ComparedRun& b) const {
    const RunLines lines = lines_of_cuts(run, b.path, rules_.placing);
    const ClSurface surface = stitch(gather(b.path), *lines.map);
    Trajectory path = b.path;
    state_tool_axes(path, run, lines, nullptr);
    return roughness_change({run_.log, *run_.path, *lines_.map, surface_}, {run.log, path, *lines.map, surface},
                            *run_.tool);
}

std::vector<RunDeparture> ReferenceRun::departures() const {
    return drift_ ? drift_->departures() : std::vector<RunDeparture>();
}

}  // namespace clsurf

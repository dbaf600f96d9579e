#include "identify/identify.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "identify/axis_record.h"
#include "identify/limit_parameters.h"
#include "identify/parameter_uncertainty.h"
#include "identify/planner_rules.h"
#include "identify/servo_parameters.h"
#include "pipeline/simulated_log.h"

namespace clsurf {
namespace {

/// Puts the period of the runs into the machine: the shortest, because a recorder may leave out records, but adds none.
void identify_period(std::span<const IdentifyRun> runs, Identification& result) {
    const Log& finest = *std::min_element(runs.begin(), runs.end(), [](const IdentifyRun& a, const IdentifyRun& b) {
                             return a.log->period < b.log->period;
                         })->log;
    // Controllers count nanoseconds; times in text have rounding errors.
    const double period = std::round(finest.period * 1e9) / 1e9;
    std::string note = "of the records";
    for (const auto& [log, lines, tips] : runs) {
        if (same_period(log->period, period)) continue;
        note = "of the records of " + finest.name;
        result.diagnostics.add(
            {Severity::note, "identify.period", Place::of_file(log->name),
             fmt::format("has a period of {:.6g} s, and {} has {:.6g} s", log->period, finest.name, period),
             "the servo loop of an axis is fitted to the runs of the shortest period that show its gain"});
    }
    result.machine.controller.period = period;
    result.parameters.push_back({"period", "controller", period, "s", {}, {}, std::move(note)});
}

/// Adds the fidelity of a machine in a run to `list`, or the reason why there is none to `result`: limits that the runs of
/// the fit never reached may be too low for this run.
void add_fidelity(const RecordedRun& run, const Machine& machine, std::vector<RunFidelity>& list,
                  Identification& result) {
    const std::string& name = run.part().log.name;
    try {
        const RunFidelity fidelity = run.fidelity(machine);
        if (fidelity.compared > 0)
            list.push_back(fidelity);
        else
            result.unidentified.push_back({"fidelity", "controller", name + " does not follow its program anywhere"});
    } catch (const InputError& error) {
        result.unidentified.push_back({"fidelity", "controller", name + " cannot be simulated: " + error.what()});
    }
}

void miss_rules(const std::string& reason, Identification& result) {
    for (const char* key :
         {"planner", "lookahead_blocks", "corner", "curve", "tolerance", "block_time", "feed", "whole_periods"})
        result.unidentified.push_back({key, "controller", reason});
}

}  // namespace

Identification identify(std::span<const IdentifyRun> runs, const Machine& known) {
    if (runs.empty()) throw InputError({}, "nothing can be identified without a run");
    Identification result;
    result.machine = known;
    std::vector<const Log*> logs;
    for (const auto& [log, lines, tips] : runs) {
        logs.push_back(log);
        result.runs.push_back(log->name);
    }
    identify_period(runs, result);
    const std::size_t before = result.parameters.size();
    identify_servos(logs, result);
    identify_limits(runs, result);
    if (result.parameters.size() == before) {
        const std::string reason = result.unidentified.empty() ? "no positions of axes"
                                                               : "axis " + result.unidentified.front().axis + ": " +
                                                                     result.unidentified.front().reason;
        throw InputError(Place::of_file(runs.front().log->name), "nothing can be identified: " + reason,
                         "give a run with changes of speed that has commanded and feedback positions (cmd.x, fb.x)");
    }
    result.machine.uncertainty = uncertainty_of(result);
    return result;
}

Identification identify_parts(std::span<const Part> parts, const Machine& known) {
    std::vector<IdentifyRun> runs;
    for (const Part& part : parts)
        runs.push_back({&part.log, part.lines.get(), part.path.kinematics != nullptr ? &part.path : nullptr});
    Identification result = identify(runs, known);
    if (const std::string reason = why_not_simulated(parts, known); !reason.empty()) {
        miss_rules(reason, result);
        return result;
    }
    std::vector<RecordedRun> recorded;
    for (const Part& part : parts) recorded.emplace_back(part);
    if (!identify_rules(recorded, result)) miss_rules("no run follows its program", result);
    for (const RecordedRun& run : recorded) add_fidelity(run, result.machine, result.fit, result);
    result.machine.fidelity = summary_of(result.fit, FidelityBasis::fit);
    result.machine.uncertainty = uncertainty_of(result);
    return result;
}

std::string why_not_simulated(std::span<const Part> parts, const Machine& known) {
    for (const Part& part : parts) {
        if (!part.log.has(Role::commanded)) return part.log.name + " has no commanded positions";
        if (part.program.motions.size() == 0) return part.log.name + " has no program";
        if (!find_rotary_motion(part.log, Role::commanded) || runs_on_five_axes(part.program, known)) continue;
        return part.log.name + (known.kinematics.has_rotary()
                                    ? " moves rotary axes, and its program does not"
                                    : " moves rotary axes, and the kinematics are not known (--machine)");
    }
    return {};
}

void cross_validate(std::vector<Part>& parts, const Machine& known, Identification& result) {
    if (parts.size() < 2 || !why_not_simulated(parts, known).empty()) return;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        std::rotate(parts.begin(), parts.begin() + 1, parts.end());  // the last one is left out
        const Identification others = identify_parts(std::span(parts).first(parts.size() - 1), known);
        add_fidelity(RecordedRun(parts.back()), others.machine, result.cross_validation, result);
    }
    result.machine.fidelity = summary_of(result.cross_validation, FidelityBasis::cross_validation);
}

void test_runs(std::span<const Part> parts, Identification& result) {
    for (const Part& part : parts) {
        if (const std::string reason = why_not_simulated({&part, 1}, result.machine); !reason.empty())
            result.unidentified.push_back({"fidelity", "controller", "not tested: " + reason});
        else
            add_fidelity(RecordedRun(part), result.machine, result.tests, result);
    }
    if (!result.tests.empty()) result.machine.fidelity = summary_of(result.tests, FidelityBasis::test);
}

}  // namespace clsurf

#include "identify/identify.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "identify/limit_parameters.h"
#include "identify/servo_parameters.h"

namespace clsurf {
namespace {

constexpr const char* rules_are_given = "rules of the planner are not fitted";

/// Puts the period of the runs into the machine.
void identify_period(std::span<const IdentifyRun> runs, Identification& result) {
    constexpr double same = 1e-6;  // relative
    const double period = runs.front().log->period;
    for (const auto& [log, lines] : runs) {
        if (std::abs(log->period - period) > same * period)
            throw InputError(
                Place::of_file(log->name),
                fmt::format("has a period of {} s, but {} has {} s", log->period, runs.front().log->name, period),
                "identify from logs of one period");
    }
    result.machine.controller.period = period;
    result.parameters.push_back({"period", "controller", period, "s", {}, {}, "of the records"});
}

}  // namespace

Identification identify(std::span<const IdentifyRun> runs, const Machine& known) {
    Identification result;
    result.machine = known;
    std::vector<const Log*> logs;
    for (const auto& [log, lines] : runs) {
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
                         "needed are commanded and fed-back positions (cmd.x, fb.x) of a run with changes of speed");
    }
    for (const char* key : {"lookahead_blocks", "corner", "curve", "tolerance", "chord_tolerance", "block_time"})
        result.unidentified.push_back({key, "controller", rules_are_given});
    result.unidentified.push_back({"max_normal_acceleration", "path", rules_are_given});
    return result;
}

}  // namespace clsurf

#include "identify/identify.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "identify/servo_parameters.h"

namespace clsurf {
namespace {

/// Puts the period of the runs into the machine.
void identify_period(std::span<const Log* const> runs, Identification& result) {
    constexpr double same = 1e-6;  // relative
    const double period = runs.front()->period;
    for (const Log* log : runs) {
        if (std::abs(log->period - period) > same * period)
            throw InputError(
                Place::of_file(log->name),
                fmt::format("has a period of {} s, but {} has {} s", log->period, runs.front()->name, period),
                "identify from logs of one period");
    }
    result.machine.controller.period = period;
    result.parameters.push_back({"period", "controller", period, "s", {}, {}, "of the records"});
}

}  // namespace

Identification identify(std::span<const Log* const> runs, const Machine& known) {
    Identification result;
    result.machine = known;
    for (const Log* log : runs) result.runs.push_back(log->name);
    identify_period(runs, result);
    const std::size_t before = result.parameters.size();
    identify_servos(runs, result);
    if (result.parameters.size() == before) {
        const std::string reason = result.unidentified.empty() ? "no positions of axes"
                                                               : "axis " + result.unidentified.front().axis + ": " +
                                                                     result.unidentified.front().reason;
        throw InputError(Place::of_file(runs.front()->name), "nothing can be identified: " + reason,
                         "needed are commanded and fed-back positions (cmd.x, fb.x) of a run with changes of speed");
    }
    return result;
}

}  // namespace clsurf

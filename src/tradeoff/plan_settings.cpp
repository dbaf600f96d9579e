#include "tradeoff/plan_settings.h"

#include <algorithm>

#include <fmt/format.h>

namespace clsurf {

std::string text_of(const PlanSettings& settings) {
    std::string text;
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
    const auto add_share = [&](const char* name, double share) {
        if (share != 1) add(fmt::format("{} {:g} %", name, 100 * share));
    };
    add_share("jerk", settings.jerk);
    add_share("acceleration", settings.acceleration);
    add_share("feed", settings.feed);
    if (settings.intervals) add("intervals");
    return text.empty() ? "as the machine file" : text;
}

bool limits_jerk(const Machine& machine) {
    if (machine.controller.planner == PlannerKind::trapezoidal) return false;
    const bool of_an_axis =
        std::ranges::any_of(machine.axes, [](const MachineAxis& axis) { return axis.max_jerk > 0; });
    // A larger jerk limit lets the acceleration reverse within a period.
    return of_an_axis || machine.path.max_jerk < 2 * machine.path.max_acceleration / machine.controller.period;
}

Machine with_settings(Machine machine, const PlanSettings& settings) {
    if (settings == PlanSettings{}) return machine;
    const auto lower = [&](MachineAxis& axis) {
        axis.max_jerk *= settings.jerk;
        axis.max_acceleration *= settings.acceleration;
    };
    std::ranges::for_each(machine.axes, lower);
    std::ranges::for_each(machine.rotary, lower);
    machine.path.max_jerk *= settings.jerk;
    machine.path.max_acceleration *= settings.acceleration;
    machine.path.max_normal_acceleration *= settings.acceleration;
    machine.controller.feed_override *= settings.feed;
    if (settings.intervals) machine.controller.feed = FeedRule::intervals;
    machine.name += ": " + text_of(settings);
    machine.fidelity.reset();
    machine.uncertainty.clear();
    return machine;
}

}  // namespace clsurf

#include "machine/planning_value.h"

#include <cmath>

#include "core/units.h"

namespace clsurf {
namespace {

/// A value that determines planned speeds: one of both members, and the unit of the machine file in internal units.
struct PlanningValue {
    double* real = nullptr;
    int* whole = nullptr;
    double unit = 1;
};

PlanningValue scaled(double& value, double unit) { return {.real = &value, .unit = unit}; }

PlanningValue whole(int& value) { return {.whole = &value}; }

std::optional<PlanningValue> axis_value(MachineAxis& axis, std::string_view key, double unit) {
    if (key == "max_speed") return scaled(axis.max_speed, unit / seconds_per_minute);
    if (key == "max_acceleration") return scaled(axis.max_acceleration, unit);
    if (key == "max_jerk") return scaled(axis.max_jerk, unit);
    return std::nullopt;
}

std::optional<PlanningValue> path_value(PathLimits& path, std::string_view key) {
    if (key == "max_speed") return scaled(path.max_speed, 1 / seconds_per_minute);
    if (key == "max_acceleration") return scaled(path.max_acceleration, 1);
    if (key == "max_normal_acceleration") return scaled(path.max_normal_acceleration, 1);
    if (key == "max_jerk") return scaled(path.max_jerk, 1);
    return std::nullopt;
}

std::optional<PlanningValue> controller_value(ControllerSettings& c, std::string_view key) {
    constexpr double percent = 0.01;
    if (key == "tolerance") return scaled(c.tolerance, 1);
    if (key == "block_time") return scaled(c.block_time, 1);
    if (key == "lookahead_blocks") return whole(c.lookahead_blocks);
    if (key == "blocks_per_period") return whole(c.trapezoid.blocks_per_period);
    if (key == "max_feed_override") return scaled(c.trapezoid.max_feed_override, percent);
    return std::nullopt;
}

std::optional<PlanningValue> value_of(Machine& machine, std::string_view key, std::string_view of) {
    if (of == "path") return path_value(machine.path, key);
    if (of == "controller") return controller_value(machine.controller, key);
    MachineAxis* const axis = of.size() == 1 ? machine.axis(of.front()) : nullptr;
    if (axis == nullptr) return std::nullopt;
    return axis_value(*axis, key, of.front() < 'x' ? rad_per_deg : 1);
}

}  // namespace

std::optional<double> planning_value(const Machine& machine, std::string_view key, std::string_view of) {
    Machine copy = machine;
    const std::optional<PlanningValue> value = value_of(copy, key, of);
    if (!value) return std::nullopt;
    return value->real != nullptr ? *value->real / value->unit : static_cast<double>(*value->whole);
}

void set_planning_value(Machine& machine, std::string_view key, std::string_view of, double value) {
    const std::optional<PlanningValue> known = value_of(machine, key, of);
    if (!known) return;
    if (known->real != nullptr)
        *known->real = value * known->unit;
    else
        *known->whole = static_cast<int>(std::lround(value));
}

bool is_planning_value(std::string_view key, std::string_view of) {
    return planning_value(Machine(), key, of).has_value();
}

}  // namespace clsurf

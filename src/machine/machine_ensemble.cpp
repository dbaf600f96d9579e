#include "machine/machine_ensemble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "core/units.h"

namespace clsurf {
namespace {

/// A value that plans the motion, in the unit of the machine file.
struct PlanningValue {
    std::function<double()> get;
    std::function<void(double)> set;
};

PlanningValue scaled(double& value, double unit) {
    return {[&value, unit] { return value / unit; }, [&value, unit](double given) { value = given * unit; }};
}

PlanningValue whole(int& value) {
    return {[&value] { return static_cast<double>(value); },
            [&value](double given) { value = static_cast<int>(std::lround(given)); }};
}

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
    const auto axis = std::find(axis_names.begin(), axis_names.end(), of);
    if (axis != axis_names.end())
        return axis_value(machine.axes[static_cast<std::size_t>(axis - axis_names.begin())], key, 1);
    const Kinematics& kinematics = machine.kinematics;
    if (!kinematics.has_rotary() || of.size() != 1) return std::nullopt;
    if (of.front() == kinematics.tilt.letter) return axis_value(machine.rotary[0], key, rad_per_deg);
    if (of.front() == kinematics.rotation.letter) return axis_value(machine.rotary[1], key, rad_per_deg);
    return std::nullopt;
}

bool is_acceleration(std::string_view key) { return key == "max_acceleration" || key == "max_normal_acceleration"; }

/// What is assumed of a machine whose file says nothing.
std::vector<ParameterUncertainty> assumed_uncertainty(const Kinematics& kinematics) {
    std::vector<std::string> axes(axis_names.begin(), axis_names.end());
    if (kinematics.has_rotary()) {
        axes.emplace_back(1, kinematics.tilt.letter);
        axes.emplace_back(1, kinematics.rotation.letter);
    }
    std::vector<ParameterUncertainty> rows;
    for (const std::string& axis : axes) {
        rows.push_back({"max_acceleration", axis, assumed_acceleration_error});
        rows.push_back({"max_jerk", axis, assumed_jerk_error});
    }
    rows.push_back({"max_acceleration", "path", assumed_acceleration_error});
    rows.push_back({"max_normal_acceleration", "path", assumed_acceleration_error});
    rows.push_back({"max_jerk", "path", assumed_jerk_error});
    return rows;
}

/// Standard normal, the same on every platform: the sum of twelve uniform numbers, less six.
double draw_normal(std::mt19937_64& random) {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(random() >> 11) * 0x1p-53;
    return sum;
}

void draw(const ParameterUncertainty& known, double speed_error, std::size_t turn, std::mt19937_64& random,
          Machine& machine) {
    const double normal = draw_normal(random);
    const std::optional<PlanningValue> value = value_of(machine, known.key, known.of);
    if (!value) return;
    if (!known.alternatives.empty()) {
        value->set(known.alternatives[turn % known.alternatives.size()]);
        return;
    }
    const double now = value->get();
    if (known.lower_bound > 0 && known.lower_bound < now) {
        const double share = 0.5 * std::erfc(-normal / std::sqrt(2.0));
        value->set(known.lower_bound * std::pow(now / known.lower_bound, share));
        return;
    }
    const double added = is_acceleration(known.key) ? speed_error : 0;
    value->set(now * std::exp(std::hypot(known.relative_error, added) * normal));
}

}  // namespace

bool is_planning_value(std::string_view key, std::string_view of) {
    Machine machine;
    return value_of(machine, key, of).has_value();
}

std::vector<Machine> machines_drawn_from(const Machine& machine, int count) {
    const std::vector<ParameterUncertainty> rows =
        machine.uncertainty.empty() ? assumed_uncertainty(machine.kinematics) : machine.uncertainty;
    const double speed_error = machine.fidelity ? machine.fidelity->speed_error_p95_ratio : 0;
    std::vector<Machine> drawn;
    for (int k = 0; k < count; ++k) {
        std::mt19937_64 random(static_cast<std::uint64_t>(k) + 1);
        drawn.push_back(machine);
        for (const ParameterUncertainty& known : rows)
            draw(known, speed_error, static_cast<std::size_t>(k), random, drawn.back());
    }
    return drawn;
}

}  // namespace clsurf

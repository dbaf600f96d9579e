// Machine files: speeds mm/min, accelerations mm/s², jerks mm/s³, lengths mm, times s; rotary axes have
// deg instead of mm.
#include "io/readers/machine_file.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/spelling.h"
#include "core/units.h"
#include "io/files/toml_table.h"
#include "io/readers/fidelity_section.h"
#include "io/readers/kinematics_section.h"
#include "io/readers/uncertainty_section.h"

namespace clsurf::io {
namespace {

constexpr double most_dead_periods = 100;  ///< longest dead time of an axis, in periods
constexpr double no_bound = std::numeric_limits<double>::infinity();

enum class Low : unsigned char { above_zero, zero };

/// Reads the value of a key if it is given and valid: value = given · factor.
void take(const TomlFile& file, const toml::table& table, std::string_view key, double& value, Low low,
          double factor = 1.0, double high = no_bound) {
    const std::optional<double> given = file.number(table, key);
    if (!given) return;
    const bool possible = (low == Low::zero ? *given >= 0 : *given > 0) && *given <= high;
    if (!possible) {
        const std::string from = low == Low::zero ? "0 or more" : "more than 0";
        const std::string to = high < no_bound ? fmt::format(", at most {}", high) : std::string();
        file.fail(*table.get(key), fmt::format("'{}' is {}, expected {}{}", key, *given, from, to));
    }
    value = *given * factor;
}

/// One of the words of a key.
std::string_view take_word(const TomlFile& file, const toml::table& table, std::string_view key,
                           std::span<const std::string_view> words) {
    const std::optional<std::string> given = file.text(table, key);
    if (!given) return {};
    const auto found = std::find(words.begin(), words.end(), *given);
    if (found == words.end()) {
        std::string hint = did_you_mean(*given, words);
        if (hint.empty()) hint = fmt::format("one of: {}", fmt::join(words, ", "));
        file.fail(*table.get(key), fmt::format("'{}' is '{}', which is not known", key, *given), hint);
    }
    return *found;
}

/// One of the values of an enumeration, by its name.
template <std::size_t Count, typename Mode>
void take_mode(const TomlFile& file, const toml::table& table, std::string_view key, Mode& value) {
    std::array<std::string_view, Count> names;
    for (std::size_t i = 0; i < Count; ++i) names[i] = name_of(static_cast<Mode>(i));
    const std::string_view name = take_word(file, table, key, names);
    if (!name.empty()) value = static_cast<Mode>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The settings of the trapezoidal planner in place of corner rounding.
void read_trapezoid(const TomlFile& file, const toml::table& table, TrapezoidSettings& t) {
    if (const auto arcs = file.boolean(table, "arc_blends")) t.arc_blends = *arcs;
    if (const auto cubic = file.boolean(table, "cubic_interpolation")) t.cubic_interpolation = *cubic;
    if (const auto blocks = file.integer(table, "blocks_per_period", 1, 1000))
        t.blocks_per_period = static_cast<int>(*blocks);
    take(file, table, "gap_periods", t.gap_periods, Low::zero);
    take(file, table, "ramp_frequency", t.ramp_frequency, Low::above_zero);
    take(file, table, "kink_ratio", t.kink_ratio, Low::above_zero, 1.0, 0.7071);
    constexpr double percent = 0.01;
    take(file, table, "max_feed_override", t.max_feed_override, Low::above_zero, percent, 1000);
}

/// The time that determines when arcs replace corners if axes have jerk limits. Domain: the period is known.
void read_arc_steps(const TomlFile& file, const toml::table& table, ControllerSettings& c) {
    take(file, table, "arc_step_time", c.arc_step_time, Low::zero, 1.0, 1.0);
    if (c.arc_step_time > 0 && c.arc_step_time < c.period)
        file.fail(
            *table.get("arc_step_time"),
            fmt::format("'arc_step_time' is {}, expected 0 or at least the period, {}", c.arc_step_time, c.period));
}

/// A number, or "program" if the planner follows the program.
void read_merging(const TomlFile& file, const toml::table& table, ControllerSettings& c) {
    const toml::node* node = table.get("merging_tolerance");
    if (node == nullptr) return;
    const bool of_program = c.planner == PlannerKind::trapezoidal && node->is_string();
    if (of_program) {
        (void)take_word(file, table, "merging_tolerance", std::array{std::string_view("program")});
        return;
    }
    double tolerance = 0;
    take(file, table, "merging_tolerance", tolerance, Low::zero);
    c.merging_tolerance = tolerance;
}

/// Rules for corners that are not rounded.
void read_junction(const TomlFile& file, const toml::table& table, JunctionSettings& junction) {
    take(file, table, "junction_deviation", junction.deviation, Low::zero);
    take(file, table, "junction_speed_step", junction.speed_step, Low::zero, 1 / seconds_per_minute);
    if (junction.deviation == 0 && junction.speed_step == 0)
        file.fail(*table.get("junction_deviation"),
                  "corners have no rule: give junction_deviation or junction_speed_step");
}

/// Refuses known keys that conflict with another setting, `with`.
void refuse(const TomlFile& file, const toml::table& table, std::initializer_list<std::string_view> keys,
            std::string_view with) {
    for (const std::string_view key : keys) {
        if (const toml::node* node = table.get(key))
            file.fail(*node, fmt::format("'{}' has no effect with {}", key, with), "remove the line");
    }
}

constexpr std::string_view with_trapezoidal = "planner = \"trapezoidal\"";

/// Refuses keys of another planner, or of other corners, which would have no effect.
void refuse_without_effect(const TomlFile& file, const toml::table& table, const ControllerSettings& c) {
    if (c.planner == PlannerKind::trapezoidal) {
        refuse(file, table,
               {"corner", "curve", "chord_tolerance", "block_time", "whole_periods", "lookahead_distance",
                "replan_blocks", "arc_step_time", "junction_deviation", "junction_speed_step"},
               with_trapezoidal);
        return;
    }
    refuse(file, table,
           {"arc_blends", "gap_periods", "ramp_frequency", "kink_ratio", "max_feed_override", "blocks_per_period",
            "cubic_interpolation"},
           "planner = \"time-optimal\"");
    const std::string with_corner = fmt::format("corner = \"{}\"", name_of(c.corner));
    if (c.corner == CornerMode::junction)
        refuse(file, table, {"curve", "tolerance"}, with_corner);
    else
        refuse(file, table, {"junction_deviation", "junction_speed_step"}, with_corner);
    if (c.corner != CornerMode::arc) refuse(file, table, {"arc_step_time"}, with_corner);
    if (!rounds_corners(c)) refuse(file, table, {"merging_tolerance"}, with_corner);
}

void read_controller(const TomlFile& file, const toml::table& table, ControllerSettings& c) {
    take_mode<2>(file, table, "planner", c.planner);
    if (c.planner != PlannerKind::trapezoidal) take_mode<4>(file, table, "corner", c.corner);
    refuse_without_effect(file, table, c);
    if (c.planner == PlannerKind::trapezoidal) {
        file.allow(table, {"planner", "feed", "period", "lookahead_blocks", "tolerance", "feed_override", "arc_blends",
                           "gap_periods", "ramp_frequency", "kink_ratio", "max_feed_override", "blocks_per_period",
                           "cubic_interpolation", "merging_tolerance"});
        read_trapezoid(file, table, c.trapezoid);
    } else {
        std::vector<std::string_view> keys{
            "planner", "feed",       "period",        "lookahead_blocks", "lookahead_distance", "replan_blocks",
            "corner",  "block_time", "whole_periods", "feed_override",    "chord_tolerance"};
        if (c.corner == CornerMode::junction) {
            keys.insert(keys.end(), {"junction_deviation", "junction_speed_step"});
        } else {
            keys.insert(keys.end(), {"curve", "tolerance"});
        }
        if (c.corner == CornerMode::arc) keys.emplace_back("arc_step_time");
        if (rounds_corners(c)) keys.emplace_back("merging_tolerance");
        file.allow(table, keys);
        read_junction(file, table, c.junction);
    }
    take_mode<2>(file, table, "feed", c.feed);
    take(file, table, "period", c.period, Low::above_zero, 1.0, 1.0);
    read_arc_steps(file, table, c);
    read_merging(file, table, c);
    if (const auto blocks = file.integer(table, "lookahead_blocks", 2, 100000))
        c.lookahead_blocks = static_cast<int>(*blocks);
    take_mode<3>(file, table, "curve", c.curve);
    take(file, table, "tolerance", c.tolerance, Low::above_zero);
    take(file, table, "chord_tolerance", c.chord_tolerance, Low::above_zero);
    take(file, table, "block_time", c.block_time, Low::zero, 1.0, 1.0);
    take(file, table, "lookahead_distance", c.lookahead_distance, Low::zero);
    if (const auto blocks = file.integer(table, "replan_blocks", 0, 100000))
        c.replan_blocks = static_cast<int>(*blocks);
    if (const auto whole = file.boolean(table, "whole_periods")) c.whole_periods = *whole;
    constexpr double percent = 0.01;
    take(file, table, "feed_override", c.feed_override, Low::above_zero, percent, 1000);
}

void read_path(const TomlFile& file, const toml::table& table, PlannerKind planner, PathLimits& path) {
    if (planner == PlannerKind::trapezoidal) refuse(file, table, {"max_jerk"}, with_trapezoidal);
    file.allow(table, {"max_speed", "max_acceleration", "max_normal_acceleration", "max_jerk"});
    take(file, table, "max_speed", path.max_speed, Low::above_zero, 1 / seconds_per_minute);
    take(file, table, "max_acceleration", path.max_acceleration, Low::above_zero);
    take(file, table, "max_normal_acceleration", path.max_normal_acceleration, Low::above_zero);
    if (planner != PlannerKind::trapezoidal) take(file, table, "max_jerk", path.max_jerk, Low::above_zero);
}

void read_travel(const TomlFile& file, const toml::table& table, double factor, MachineAxis& axis) {
    const toml::node* node = table.get("travel");
    if (node == nullptr) return;
    const toml::array* ends = node->as_array();
    if (ends == nullptr || ends->size() != 2 || !ends->get(0)->is_number() || !ends->get(1)->is_number()) {
        file.fail(*node, "'travel' must be two numbers, [low, high]");
    }
    const double low = *ends->get(0)->value<double>();
    const double high = *ends->get(1)->value<double>();
    if (!(low < high)) file.fail(*node, fmt::format("travel is reversed: [{}, {}]", low, high));
    axis.travel_low = low * factor;
    axis.travel_high = high * factor;
}

void read_servo(const TomlFile& file, const toml::table& table, double period, double factor, ServoModel& servo) {
    file.allow(table, {"position_gain", "velocity_feedforward", "velocity_time_constant", "velocity_integral_time",
                       "dead_time", "quantum", "noise", "backlash", "friction"});
    take(file, table, "position_gain", servo.position_gain, Low::above_zero, 1.0, 1 / period);
    take(file, table, "velocity_feedforward", servo.velocity_feedforward, Low::zero, 1.0, 2.0);
    take(file, table, "velocity_time_constant", servo.velocity_time_constant, Low::zero);
    take(file, table, "velocity_integral_time", servo.velocity_integral_time, Low::zero);
    take(file, table, "dead_time", servo.dead_time, Low::zero, 1.0, most_dead_periods * period);
    take(file, table, "quantum", servo.quantum, Low::zero, factor);
    take(file, table, "noise", servo.noise, Low::zero, factor);
    take(file, table, "backlash", servo.backlash, Low::zero, factor);
    take(file, table, "friction", servo.friction, Low::zero, factor / seconds_per_minute);
    // Kv·T_v ≥ 1: the loop s(1 + s T_v) + Kv is poorly damped.
    if (servo.position_gain * servo.velocity_time_constant >= 1) {
        file.fail(
            table,
            fmt::format("the loop does not settle: position_gain {} · velocity_time_constant {} must be less than 1",
                        servo.position_gain, servo.velocity_time_constant));
    }
    if (servo.velocity_integral_time > 0 && servo.velocity_integral_time < period) {
        file.fail(*table.get("velocity_integral_time"),
                  fmt::format("'velocity_integral_time' is {}: it must be 0, or at least the period of {} s",
                              servo.velocity_integral_time, period));
    }
}

void read_axis(const TomlFile& file, const toml::table& table, std::vector<std::string_view>& seen, Machine& machine) {
    if (machine.controller.planner == PlannerKind::trapezoidal) refuse(file, table, {"max_jerk"}, with_trapezoidal);
    file.allow(table, {"name", "travel", "max_speed", "max_acceleration", "max_jerk", "servo"});
    std::vector<std::string_view> names(axis_names.begin(), axis_names.end());
    const Kinematics& kinematics = machine.kinematics;
    if (kinematics.has_rotary())
        names.insert(names.end(), {{&kinematics.tilt.letter, 1}, {&kinematics.rotation.letter, 1}});
    const std::string_view name = take_word(file, table, "name", names);
    if (name.empty()) file.fail(table, "axis without 'name'");
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
        file.fail(*table.get("name"), fmt::format("axis '{}' is given twice", name));
    seen.push_back(name);
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    const bool rotary = index >= axis_names.size();
    MachineAxis& axis = rotary ? machine.rotary[index - axis_names.size()] : machine.axes[index];
    const double factor = rotary ? rad_per_deg : 1.0;
    read_travel(file, table, factor, axis);
    take(file, table, "max_speed", axis.max_speed, Low::above_zero, factor / seconds_per_minute);
    take(file, table, "max_acceleration", axis.max_acceleration, Low::above_zero, factor);
    if (machine.controller.planner != PlannerKind::trapezoidal)
        take(file, table, "max_jerk", axis.max_jerk, Low::zero, factor);
    if (const toml::table* servo = file.section(table, "servo"))
        read_servo(file, *servo, machine.controller.period, factor, axis.servo);
}

std::string axis_text(std::string_view name, const MachineAxis& a, double factor, bool with_jerk) {
    const auto whole = [&](double value) { return twelve_digits(value / factor); };
    std::string text =
        fmt::format("\n[[axis]]\nname = \"{}\"\ntravel = [{}, {}]\n", name, whole(a.travel_low), whole(a.travel_high));
    text += fmt::format("max_speed = {}\nmax_acceleration = {}\n", whole(a.max_speed * seconds_per_minute),
                        whole(a.max_acceleration));
    if (with_jerk) text += fmt::format("max_jerk = {}               # 0: not limited\n", whole(a.max_jerk));
    text += "[axis.servo]\n";
    text += fmt::format("position_gain = {}            # 1/s\n", a.servo.position_gain);
    text += fmt::format("velocity_feedforward = {}    # 1: no lag at constant speed\n", a.servo.velocity_feedforward);
    text += fmt::format("velocity_time_constant = {}\n", a.servo.velocity_time_constant);
    text += fmt::format("velocity_integral_time = {}      # of the velocity loop's PI controller; 0: none\n",
                        a.servo.velocity_integral_time);
    text += fmt::format("dead_time = {}               # from the command to the loop\n", a.servo.dead_time);
    text += fmt::format("quantum = {}               # encoder step; 0: none\n", whole(a.servo.quantum));
    text += fmt::format("noise = {}                    # rms\n", whole(a.servo.noise));
    text += fmt::format("backlash = {}                 # play between drive and table\n", whole(a.servo.backlash));
    return text + fmt::format("friction = {}                 # speed lost to Coulomb friction, {}/min\n",
                              whole(a.servo.friction * seconds_per_minute), factor == 1 ? "mm" : "deg");
}

/// The keys of the planner.
std::string controller_text(const ControllerSettings& c) {
    std::string text;
    if (c.planner == PlannerKind::trapezoidal) text += fmt::format("planner = \"{}\"\n", name_of(c.planner));
    text += fmt::format(
        "feed = \"{}\"           # highest speed; intervals: less where a constant-speed interval is planned to be slower\n",
        name_of(c.feed));
    text += fmt::format("period = {}                # interpolation period\n", c.period);
    text += fmt::format("lookahead_blocks = {}\n", c.lookahead_blocks);
    const std::string tolerance =
        fmt::format("tolerance = {}              # of corners and path; G64 P in a program replaces it\n", c.tolerance);
    if (c.planner == PlannerKind::trapezoidal) {
        const TrapezoidSettings& t = c.trapezoid;
        text += tolerance;
        text += fmt::format("merging_tolerance = {}  # {}\n",
                            c.merging_tolerance ? fmt::format("{}", *c.merging_tolerance) : "\"program\"",
                            "of lines that become one, in place of Q of G64; program: Q counts");
        text += fmt::format("arc_blends = {}           # corners become arcs where that is faster\n", t.arc_blends);
        text +=
            fmt::format("gap_periods = {}             # a line that is left shorter joins the arc\n", t.gap_periods);
        text += fmt::format("ramp_frequency = {}        # Hz: blocks of less than its period run at one acceleration\n",
                            t.ramp_frequency);
        text += fmt::format("kink_ratio = {}            # of the acceleration, for steps of direction\n", t.kink_ratio);
        text += fmt::format("max_feed_override = {}     # %, that corners are planned for\n",
                            twelve_digits(t.max_feed_override * 100));
        text += fmt::format("blocks_per_period = {}       # that reach the planner\n", t.blocks_per_period);
        return text + fmt::format("cubic_interpolation = {} # set points on a cubic B-spline\n", t.cubic_interpolation);
    }
    text += fmt::format(
        "corner = \"{}\"                # rounded inside the tolerance: by arcs, with jerk limits of axes see arc_step_time; spline: by splines; stop: exact stop; junction: passed without rounding\n",
        name_of(c.corner));
    if (c.corner == CornerMode::junction) {
        text += fmt::format("junction_deviation = {}      # of the arc whose speed a corner has; 0: no rule\n",
                            c.junction.deviation);
        text += fmt::format("junction_speed_step = {}     # of an axis in a corner; 0: no rule\n",
                            twelve_digits(c.junction.speed_step * seconds_per_minute));
    } else {
        text += fmt::format("curve = \"{}\"                   # through short lines: akima, least-squares or none\n",
                            name_of(c.curve));
        text += tolerance;
    }
    if (rounds_corners(c))
        text +=
            fmt::format("merging_tolerance = {}         # lines within it of one line become that line; 0: none do\n",
                        c.merging_tolerance.value_or(0));
    if (c.corner == CornerMode::arc) {
        text += fmt::format(
            "arc_step_time = {}             # s, arcs also with jerk limits of axes, whose accelerations step in it; 0: splines\n",
            c.arc_step_time);
    }
    text += fmt::format("chord_tolerance = {}       # of the steps of a period against arcs\n", c.chord_tolerance);
    text += fmt::format("block_time = {}                # s, a block takes no less; 0: not limited\n", c.block_time);
    text += fmt::format("whole_periods = {}         # a block at its feed takes a whole number of periods\n",
                        c.whole_periods);
    text += fmt::format("lookahead_distance = {}        # known after the block that runs; 0: not limited\n",
                        c.lookahead_distance);
    return text +
           fmt::format(
               "replan_blocks = {}             # that run before speeds are planned again; 0: half of those known\n",
               c.replan_blocks);
}

/// A text as a TOML string: in quotes, with escapes.
std::string quoted(const std::string& text) {
    std::ostringstream out;
    const toml::value<std::string> value(text);
    out << toml::toml_formatter(value, toml::format_flags::none);
    return out.str();
}

/// A discrete loop with a gain above 1/period is unstable. The gain may be a default that the file does not give.
void refuse_unstable_servos(const TomlFile& file, const Machine& machine) {
    const double period = machine.controller.period;
    const auto refuse = [&](std::string_view name, const MachineAxis& axis) {
        if (axis.servo.position_gain * period > 1)
            file.fail(fmt::format(
                "axis '{}': with a position_gain of {} 1/s and a period of {} s the loop does not settle; give it a position_gain of at most {:.4g}",
                name, axis.servo.position_gain, period, 1 / period));
    };
    for (std::size_t i = 0; i < machine.axes.size(); ++i) refuse(axis_names[i], machine.axes[i]);
    if (!machine.kinematics.has_rotary()) return;
    refuse({&machine.kinematics.tilt.letter, 1}, machine.rotary[0]);
    refuse({&machine.kinematics.rotation.letter, 1}, machine.rotary[1]);
}

Machine read_machine(const TomlFile& file) {
    const toml::table& root = file.root();
    file.allow(root, {"name", "controller", "path", "axis", "kinematics", "fidelity", "uncertainty"});
    Machine machine;
    machine.name = file.text(root, "name").value_or(machine.name);
    if (const toml::table* table = file.section(root, "controller")) read_controller(file, *table, machine.controller);
    if (const toml::table* table = file.section(root, "path"))
        read_path(file, *table, machine.controller.planner, machine.path);
    const bool trapezoidal = machine.controller.planner == PlannerKind::trapezoidal;
    if (trapezoidal)
        for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    // The kinematics determine which rotary axes are possible.
    if (const toml::table* table = file.section(root, "kinematics")) {
        machine.kinematics = read_kinematics(file, *table);
        if (trapezoidal && machine.kinematics.has_rotary())
            file.fail(*table, "the trapezoidal planner is for three axes", "planner = \"time-optimal\" runs five");
        if (machine.controller.corner == CornerMode::junction && machine.kinematics.has_rotary())
            file.fail(*table, "corner = \"junction\" is for three axes", "corner = \"spline\" runs five");
        if (machine.controller.merging_tolerance.value_or(0) > 0 && machine.kinematics.has_rotary())
            file.fail(*table, "merging_tolerance is for three axes", "merging_tolerance = 0 runs five");
        if (machine.controller.arc_step_time > 0 && machine.kinematics.has_rotary())
            file.fail(*table, "arc_step_time is for three axes", "corner = \"spline\" runs five");
    }
    if (const toml::array* axes = file.tables(root, "axis")) {
        std::vector<std::string_view> seen;
        for (const toml::node& node : *axes) read_axis(file, *node.as_table(), seen, machine);
    }
    refuse_unstable_servos(file, machine);
    if (const toml::table* table = file.section(root, "fidelity")) machine.fidelity = read_fidelity(file, *table);
    if (const toml::array* rows = file.tables(root, "uncertainty")) machine.uncertainty = read_uncertainty(file, *rows);
    return machine;
}

}  // namespace

Machine read_machine(const std::string& path) { return read_machine(TomlFile(path)); }

Machine machine_of_text(const std::string& text, const std::string& name) { return read_machine(TomlFile(text, name)); }

std::vector<StatedLimit> read_stated_limits(const std::string& path) {
    const Machine machine = read_machine(path);
    const TomlFile file(path);
    std::vector<StatedLimit> limits;
    const auto add_axis = [&](const toml::table& table, char letter, const MachineAxis& axis) {
        for (const LimitTableRow& row : limit_table) {
            if (row.of_axis != nullptr && table.contains(row.key) && axis.*row.of_axis > 0)
                limits.push_back({row.quantity, letter, axis.*row.of_axis});
        }
    };
    if (const toml::array* axes = file.tables(file.root(), "axis")) {
        for (const toml::node& node : *axes) {
            const toml::table& table = *node.as_table();
            const char letter = file.text(table, "name").value_or(" ").front();
            if (letter >= 'x') add_axis(table, letter, machine.axes[static_cast<std::size_t>(letter - 'x')]);
            if (letter == machine.kinematics.tilt.letter) add_axis(table, letter, machine.rotary[0]);
            if (letter == machine.kinematics.rotation.letter) add_axis(table, letter, machine.rotary[1]);
        }
    }
    if (const toml::table* table = file.section(file.root(), "path")) {
        for (const LimitTableRow& row : limit_table) {
            if (row.of_path != nullptr && table->contains(row.key))
                limits.push_back({row.quantity, 0, machine.path.*row.of_path});
        }
    }
    const toml::table* controller = file.section(file.root(), "controller");
    if (controller != nullptr && controller->contains("tolerance"))
        limits.push_back({LimitedQuantity::tolerance, 0, machine.controller.tolerance});
    return limits;
}

std::string machine_text(const Machine& machine) {
    const ControllerSettings& c = machine.controller;
    const PathLimits& p = machine.path;
    const bool jerk = c.planner != PlannerKind::trapezoidal;
    std::string text = "# Speeds mm/min, accelerations mm/s², jerks mm/s³, lengths mm, times s.\n";
    text += fmt::format("name = {}\n\n[controller]\n", quoted(machine.name));
    text += controller_text(c);
    text += fmt::format("feed_override = {}           # %, of programmed feeds\n\n[path]\n",
                        twelve_digits(c.feed_override * 100));
    text += fmt::format("max_speed = {}\n", twelve_digits(p.max_speed * seconds_per_minute));
    text += fmt::format("max_acceleration = {}        # tangential\n", p.max_acceleration);
    text += fmt::format("max_normal_acceleration = {}\n", p.max_normal_acceleration);
    if (jerk) text += fmt::format("max_jerk = {}               # tangential\n", p.max_jerk);
    for (std::size_t i = 0; i < machine.axes.size(); ++i) text += axis_text(axis_names[i], machine.axes[i], 1, jerk);
    const Kinematics& k = machine.kinematics;
    if (k.has_rotary()) {
        text += axis_text({&k.tilt.letter, 1}, machine.rotary[0], rad_per_deg, jerk);
        text += axis_text({&k.rotation.letter, 1}, machine.rotary[1], rad_per_deg, jerk);
    }
    text += kinematics_text(k);
    if (machine.fidelity) text += fidelity_text(*machine.fidelity);
    return text + uncertainty_text(machine.uncertainty);
}

}  // namespace clsurf::io

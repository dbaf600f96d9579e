#include "identify/rule_list.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

/// Whether corners are not rounded, so that the tolerance has no effect.
bool passes_corners(const Machine& machine) {
    return !is_trapezoidal(machine) && machine.controller.corner == CornerMode::junction;
}

/// A rule with numbers as values, including the present one. `unit`: of the machine file, in internal units.
template <typename Number, typename Member>
Rule rule_of_numbers(const char* name, const char* axis, const Machine& machine, std::vector<Number> numbers,
                     Member member, Number unit = 1) {
    Machine now = machine;
    const Number present = static_cast<Number>(member(now));
    if (std::find(numbers.begin(), numbers.end(), present) == numbers.end()) numbers.push_back(present);
    std::sort(numbers.begin(), numbers.end());
    Rule rule{name, axis, {}, {}};
    for (const Number number : numbers)
        rule.values.push_back({fmt::format("{:.6g}", static_cast<double>(number) / static_cast<double>(unit)),
                               [=](Machine& m) { member(m) = number; }});
    return rule;
}

/// The same with numbers between which others are possible.
template <typename Member>
Rule continuous_rule(const char* name, const char* axis, const Machine& machine, std::vector<double> numbers,
                     Member member, double unit = 1) {
    Rule rule = rule_of_numbers(name, axis, machine, std::move(numbers), member, unit);
    rule.continuous.unit = unit;
    for (const RuleValue& value : rule.values) {
        Machine with = machine;
        value.apply(with);
        rule.continuous.numbers.push_back(member(with));
    }
    rule.continuous.set = [member](Machine& m, double number) { member(m) = number; };
    return rule;
}

PlannerFamily rounded_corners(const Machine& machine) {
    PlannerFamily family;
    const ControllerSettings& now = machine.controller;
    if (machine.kinematics.has_rotary()) {
        // Arcs and splines are the same rounding there.
        const CornerMode rounded = rounds_corners(now) ? now.corner : CornerMode::spline;
        for (const CornerMode corner : {rounded, CornerMode::stop})
            family.add(fmt::format("time-optimal, corner {}", name_of(corner)), now.corner == corner,
                       [corner](Machine& m) { m.controller.corner = corner; });
        return family;
    }
    const auto add = [&](CornerMode corner, double arc_step_time, const std::string& more = {}) {
        const bool is_present =
            !is_trapezoidal(machine) && now.corner == corner &&
            (corner != CornerMode::arc || only_path_jerk(machine) || now.arc_step_time == arc_step_time);
        family.add(fmt::format("time-optimal, corner {}{}", name_of(corner), more), is_present,
                   [corner, arc_step_time](Machine& m) {
                       m.controller.planner = PlannerKind::time_optimal;
                       m.controller.corner = corner;
                       m.controller.arc_step_time = arc_step_time;
                   });
    };
    for (const CornerMode corner : {CornerMode::arc, CornerMode::spline, CornerMode::stop}) add(corner, 0);
    // Without jerk limits of the axes it equals the first one.
    if (only_path_jerk(machine)) return family;
    const double time = std::max(now.arc_step_time, now.period);
    add(CornerMode::arc, time, fmt::format(", steps in {} s", time));
    return family;
}

void add_junction(PlannerFamily& family, const std::string& name, const JunctionSettings& junction, bool is_present) {
    family.add("time-optimal, corner junction" + name, is_present, [junction](Machine& m) {
        m.controller.planner = PlannerKind::time_optimal;
        m.controller.corner = CornerMode::junction;
        m.controller.junction = junction;
    });
}

/// Corners that are not rounded. The first speeds need not be right: other rules find them. Either rule may hide the other,
/// so each has a family.
std::vector<PlannerFamily> passed_corners(const Machine& machine) {
    if (passes_corners(machine)) {
        PlannerFamily own;
        add_junction(own, "", machine.controller.junction, true);
        return {own};
    }
    constexpr double usual_step = 300 / seconds_per_minute;
    PlannerFamily by_deviation, by_speed_step;
    add_junction(by_deviation, " by deviation", {}, false);
    add_junction(by_speed_step, " by speed step", {.deviation = 0, .speed_step = usual_step}, false);
    return {by_deviation, by_speed_step};
}

PlannerFamily trapezoidal_planners(const Machine& machine) {
    PlannerFamily family;
    for (const bool arcs : {true, false}) {
        family.add(arcs ? "trapezoidal, arc blends" : "trapezoidal, parabolic blends",
                   is_trapezoidal(machine) && machine.controller.trapezoid.arc_blends == arcs, [arcs](Machine& m) {
                       // The tolerance of another planner does not determine what this one merges.
                       if (!is_trapezoidal(m)) m.controller.merging_tolerance.reset();
                       m.controller.planner = PlannerKind::trapezoidal;
                       m.controller.trapezoid.arc_blends = arcs;
                       m.path.max_acceleration = m.path.max_normal_acceleration = no_path_limit;
                       for (MachineAxis& axis : m.axes) axis.max_jerk = 0;
                   });
    }
    return family;
}

Rule path_acceleration_rule(const PathLimits& identified) {
    return {"max_acceleration",
            "path",
            {{"of the axes alone",
              [](Machine& m) { m.path.max_acceleration = m.path.max_normal_acceleration = no_path_limit; }},
             {fmt::format("{}, normal {}", identified.max_acceleration, identified.max_normal_acceleration),
              [identified](Machine& m) { m.path = identified; }}},
            {}};
}

/// Possible values of an axis acceleration, the present one first. A limit that the runs never reached may be the greatest
/// acceleration that they show. Where blocks overlap, each has half of the acceleration, and the runs may show half of a
/// limit as if it were the limit: this concerns all blocks of a planner without arc blends, and with `some_overlap` the blocks
/// that no arc joins.
std::vector<double> possible_accelerations(std::size_t axis, bool some_overlap, const Identification& found) {
    const double now = found.machine.axes[axis].max_acceleration;
    std::vector<double> values{now};
    const IdentifiedParameter* known = found.find("max_acceleration", axis_names[axis]);
    if (known == nullptr || !known->reached) return values;
    const bool all_overlap = !found.machine.controller.trapezoid.arc_blends;
    const double shown = *known->reached ? known->value : known->shown;
    const auto add = [&](double value) {
        const auto alike = [&](double other) { return std::abs(value - other) <= 0.01 * other; };
        if (std::none_of(values.begin(), values.end(), alike)) values.push_back(value);
    };
    add(shown);
    if (all_overlap || (some_overlap && *known->reached)) add(2 * shown);
    return values;
}

Rule interpolation_rule() {
    return {"cubic_interpolation",
            "controller",
            {{"true", [](Machine& m) { m.controller.trapezoid.cubic_interpolation = true; }},
             {"false", [](Machine& m) { m.controller.trapezoid.cubic_interpolation = false; }}},
            {}};
}

Rule curve_rule() {
    Rule rule{"curve", "controller", {}, {}};
    for (const CurveMode mode : {CurveMode::none, CurveMode::akima, CurveMode::least_squares})
        rule.values.push_back({std::string(name_of(mode)), [mode](Machine& m) { m.controller.curve = mode; }});
    return rule;
}

Rule feed_rule() {
    Rule rule{"feed", "controller", {}, {}};
    for (const FeedRule feed : {FeedRule::programmed, FeedRule::intervals})
        rule.values.push_back({std::string(name_of(feed)), [feed](Machine& m) { m.controller.feed = feed; }});
    return rule;
}

Rule whole_periods_rule() {
    return {"whole_periods",
            "controller",
            {{"false", [](Machine& m) { m.controller.whole_periods = false; }},
             {"true", [](Machine& m) { m.controller.whole_periods = true; }}},
            {}};
}

/// The speed at corners that are not rounded.
Rule junction_deviation_rule(const Machine& machine) {
    return continuous_rule("junction_deviation", "controller", machine, {0, 0.002, 0.005, 0.01, 0.02, 0.05},
                           [](Machine& m) -> double& { return m.controller.junction.deviation; });
}

Rule junction_speed_step_rule(const Machine& machine) {
    constexpr double per_minute = 1 / seconds_per_minute;
    std::vector<double> steps;
    for (const double step : {0, 50, 100, 200, 500, 1000, 2000}) steps.push_back(step * per_minute);
    return continuous_rule(
        "junction_speed_step", "controller", machine, std::move(steps),
        [](Machine& m) -> double& { return m.controller.junction.speed_step; }, per_minute);
}

Rule tolerance_rule(const Machine& machine) {
    return continuous_rule("tolerance", "controller", machine, {0.002, 0.005, 0.01, 0.02, 0.05},
                           [](Machine& m) -> double& { return m.controller.tolerance; });
}

/// Merging of short lines; the trapezoidal planner may take the tolerance from the program. A slightly different tolerance
/// merges other lines, so a number between two candidates is not nearly right: round numbers are tried, as controls have
/// them.
Rule merging_rule(const Machine& machine) {
    std::vector<double> tolerances{0, 0.001, 0.002, 0.003, 0.004, 0.005, 0.006, 0.008, 0.01, 0.015, 0.02};
    const double present = machine.controller.merging_tolerance.value_or(0);
    if (std::find(tolerances.begin(), tolerances.end(), present) == tolerances.end()) tolerances.push_back(present);
    Rule rule{"merging_tolerance", "controller", {}, {}};
    for (const double tolerance : tolerances)
        rule.values.push_back({fmt::format("{:.6g}", tolerance),
                               [tolerance](Machine& m) { m.controller.merging_tolerance = tolerance; }});
    if (is_trapezoidal(machine))
        rule.values.push_back({"program", [](Machine& m) { m.controller.merging_tolerance.reset(); }});
    return rule;
}

Rule normal_acceleration_rule(const Machine& machine) {
    return continuous_rule("max_normal_acceleration", "path", machine, {500, 1000, 1500, 2000, 4000},
                           [](Machine& m) -> double& { return m.path.max_normal_acceleration; });
}

/// The greatest deviation of the angles from the program where blocks meet.
Rule axis_tolerance_rule(const Machine& machine) {
    std::vector<double> tolerances;
    for (const double degrees : {0.02, 0.05, 0.1, 0.2, 0.5}) tolerances.push_back(degrees * rad_per_deg);
    return continuous_rule(
        "axis_tolerance", "kinematics", machine, std::move(tolerances),
        [](Machine& m) -> double& { return m.kinematics.axis_tolerance; }, rad_per_deg);
}

std::vector<std::function<Rule(const Machine&)>> rules_of_five_axes(const Machine& machine) {
    std::vector<std::function<Rule(const Machine&)>> rules;
    if (rounds_corners(machine.controller)) {
        // The roundings of the angles show more than the roundings of the tip, which could hide them, so they come first.
        rules.emplace_back(axis_tolerance_rule);
        rules.emplace_back(tolerance_rule);
        rules.emplace_back([](const Machine&) { return curve_rule(); });
    }
    rules.emplace_back(normal_acceleration_rule);
    rules.emplace_back([](const Machine&) { return feed_rule(); });
    return rules;
}

}  // namespace

bool is_trapezoidal(const Machine& machine) { return machine.controller.planner == PlannerKind::trapezoidal; }

std::vector<PlannerFamily> planner_families(const Machine& machine) {
    if (machine.kinematics.has_rotary()) return {rounded_corners(machine)};
    std::vector<PlannerFamily> families = passed_corners(machine);
    families.push_back(rounded_corners(machine));
    families.push_back(trapezoidal_planners(machine));
    return families;
}

Rule axis_accelerations_rule(bool some_overlap, const Identification& found) {
    Rule rule{"max_acceleration", "x, y, z", {}, {}};
    for (const double x : possible_accelerations(0, some_overlap, found)) {
        for (const double y : possible_accelerations(1, some_overlap, found)) {
            for (const double z : possible_accelerations(2, some_overlap, found)) {
                rule.values.push_back({fmt::format("x {:.6g}, y {:.6g}, z {:.6g}", x, y, z), [=](Machine& m) {
                                           m.axes[0].max_acceleration = x;
                                           m.axes[1].max_acceleration = y;
                                           m.axes[2].max_acceleration = z;
                                       }});
            }
        }
    }
    return rule;
}

std::vector<std::function<Rule(const Machine&)>> rules_of(const Machine& machine, const PathLimits& identified) {
    if (machine.kinematics.has_rotary()) return rules_of_five_axes(machine);
    std::vector<std::function<Rule(const Machine&)>> rules;
    if (passes_corners(machine)) {
        rules.emplace_back(junction_speed_step_rule);
        rules.emplace_back(junction_deviation_rule);
        if (!(machine.controller.junction.speed_step > 0)) std::swap(rules[0], rules[1]);
    } else {
        rules.emplace_back(tolerance_rule);
    }
    rules.emplace_back([](const Machine& m) {
        return rule_of_numbers("lookahead_blocks", "controller", m, std::vector{5, 7, 10, 14, 20, 50, 200, 1000},
                               [](Machine& x) -> int& { return x.controller.lookahead_blocks; });
    });
    if (is_trapezoidal(machine)) {
        rules.emplace_back([identified](const Machine&) { return path_acceleration_rule(identified); });
        rules.emplace_back([](const Machine&) { return interpolation_rule(); });
        rules.emplace_back([](const Machine& m) {
            return rule_of_numbers(
                "max_feed_override", "controller", m, std::vector{1.0, 1.2, 1.5, 2.0},
                [](Machine& x) -> double& { return x.controller.trapezoid.max_feed_override; }, 0.01);
        });
        rules.emplace_back([](const Machine& m) {
            return rule_of_numbers("blocks_per_period", "controller", m, std::vector{1, 2, 10},
                                   [](Machine& x) -> int& { return x.controller.trapezoid.blocks_per_period; });
        });
    } else {
        if (!passes_corners(machine)) rules.emplace_back([](const Machine&) { return curve_rule(); });
        rules.emplace_back([](const Machine& m) {
            return continuous_rule("block_time", "controller", m, std::vector{0.0, 0.001, 0.002, 0.005},
                                   [](Machine& x) -> double& { return x.controller.block_time; });
        });
        rules.emplace_back(normal_acceleration_rule);
        rules.emplace_back([](const Machine&) { return feed_rule(); });
        rules.emplace_back([](const Machine&) { return whole_periods_rule(); });
    }
    // Last, because a short look-ahead or a block time also slows short lines.
    if (is_trapezoidal(machine) || rounds_corners(machine.controller)) rules.emplace_back(merging_rule);
    return rules;
}

std::vector<OmittedRule> omitted_rules(const Machine& machine) {
    if (!machine.kinematics.has_rotary()) return {};
    constexpr const char* whole_path = "not tried: the simulation of five axes knows the whole path at once";
    constexpr const char* three_axes = "not tried: simulated on three axes only";
    return {{"planner trapezoidal, corner junction", three_axes},
            {"lookahead_blocks", whole_path},
            {"lookahead_distance", whole_path},
            {"merging_tolerance", three_axes},
            {"block_time", three_axes},
            {"whole_periods", three_axes}};
}

}  // namespace clsurf

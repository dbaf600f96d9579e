#include "identify/planner_rules.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "identify/rule_search.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr double no_limit = 1'000'000;         // mm/s²
constexpr int most_passes = 4;                 // over all rules
constexpr double explained_share = 0.002;      // of the speed: a family whose mean error is no larger is the right one
constexpr double gain_of_later_passes = 0.25;  // of the speed error: they correct what other rules hid, no details

bool is_trapezoidal(const Machine& machine) { return machine.controller.planner == PlannerKind::trapezoidal; }

/// Whether corners are not rounded, so that no tolerance counts.
bool passes_corners(const Machine& machine) {
    return !is_trapezoidal(machine) && machine.controller.corner == CornerMode::junction;
}

/// A rule of numbers, the present one among them. `unit`: of the machine file, in ours.
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

/// A rule of numbers between which others are possible. `unit`: of the machine file, in ours.
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

/// Kinds of planner that are alike: their other rules are the same.
struct PlannerFamily {
    Rule rule{"planner", "controller", {}, {}};
    std::size_t present =
        std::numeric_limits<std::size_t>::max();  ///< the machine's own kind, where it is of the family

    void add(std::string name, bool is_present, std::function<void(Machine&)> apply) {
        if (is_present) present = rule.values.size();
        rule.values.push_back({std::move(name), std::move(apply)});
    }
    [[nodiscard]] bool has_present() const { return present < rule.values.size(); }
};

PlannerFamily rounded_corners(const Machine& machine) {
    PlannerFamily family;
    const ControllerSettings& now = machine.controller;
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
    // Without jerk limits of axes it is the first one.
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

/// Corners that are not rounded, at speeds of which the next rules find the right one. Either rule may hide the other, so
/// each has a family.
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
                       m.controller.planner = PlannerKind::trapezoidal;
                       m.controller.trapezoid.arc_blends = arcs;
                       m.path.max_acceleration = m.path.max_normal_acceleration = no_limit;
                       for (MachineAxis& axis : m.axes) axis.max_jerk = 0;
                   });
    }
    return family;
}

std::vector<PlannerFamily> planner_families(const Machine& machine) {
    std::vector<PlannerFamily> families = passed_corners(machine);
    families.push_back(rounded_corners(machine));
    families.push_back(trapezoidal_planners(machine));
    return families;
}

Rule path_acceleration_rule(const PathLimits& identified) {
    return {
        "max_acceleration",
        "path",
        {{"of the axes alone", [](Machine& m) { m.path.max_acceleration = m.path.max_normal_acceleration = no_limit; }},
         {fmt::format("{}, normal {}", identified.max_acceleration, identified.max_normal_acceleration),
          [identified](Machine& m) { m.path = identified; }}},
        {}};
}

/// Values that the acceleration of an axis may have, the present one first. A limit that the runs never reached may be the
/// greatest acceleration that they show. Where blocks overlap, each has half of the acceleration, and the runs may show
/// half of a limit as if it were one.
std::vector<double> possible_accelerations(std::size_t axis, const Identification& found) {
    const double now = found.machine.axes[axis].max_acceleration;
    std::vector<double> values{now};
    const IdentifiedParameter* known = found.find("max_acceleration", axis_names[axis]);
    if (known == nullptr || !known->reached) return values;
    const bool overlap = !found.machine.controller.trapezoid.arc_blends;
    if (!*known->reached && std::abs(known->value - now) > 0.01 * now) values.push_back(known->value);
    if (overlap) values.push_back(2 * known->value);
    return values;
}

/// Every combination of these, because the slowest axis hides the others.
Rule axis_accelerations_rule(const Identification& found) {
    Rule rule{"max_acceleration", "x, y, z", {}, {}};
    for (const double x : possible_accelerations(0, found)) {
        for (const double y : possible_accelerations(1, found)) {
            for (const double z : possible_accelerations(2, found)) {
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

/// How fast corners are passed that are not rounded.
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

/// The rules that a planner of this kind has; each is searched with the others as they were found before.
std::vector<std::function<Rule(const Machine&)>> rules_of(const Machine& machine, const PathLimits& identified) {
    std::vector<std::function<Rule(const Machine&)>> rules;
    if (passes_corners(machine)) {
        rules.emplace_back(junction_speed_step_rule);
        rules.emplace_back(junction_deviation_rule);
        if (!(machine.controller.junction.speed_step > 0)) std::swap(rules[0], rules[1]);
    } else {
        rules.emplace_back([](const Machine& m) {
            return continuous_rule("tolerance", "controller", m, std::vector{0.002, 0.005, 0.01, 0.02, 0.05},
                                   [](Machine& x) -> double& { return x.controller.tolerance; });
        });
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
        rules.emplace_back([](const Machine& m) {
            return continuous_rule("max_normal_acceleration", "path", m,
                                   std::vector{500.0, 1000.0, 1500.0, 2000.0, 4000.0},
                                   [](Machine& x) -> double& { return x.path.max_normal_acceleration; });
        });
        rules.emplace_back([](const Machine&) { return feed_rule(); });
        rules.emplace_back([](const Machine&) { return whole_periods_rule(); });
    }
    return rules;
}

/// Whether two machines have the same values of all rules.
bool plan_alike(const Machine& one, const Machine& other) {
    const auto accelerate_alike = [](const MachineAxis& x, const MachineAxis& y) {
        return x.max_acceleration == y.max_acceleration;
    };
    return one.controller == other.controller && one.path == other.path &&
           std::equal(one.axes.begin(), one.axes.end(), other.axes.begin(), accelerate_alike);
}

/// The value that leaves the machine's rule as it is.
std::size_t present_value(const Rule& rule, const Machine& machine) {
    const auto same = [&](const RuleValue& value) {
        Machine changed = machine;
        value.apply(changed);
        return plan_alike(machine, changed);
    };
    return static_cast<std::size_t>(std::find_if(rule.values.begin(), rule.values.end(), same) - rule.values.begin());
}

/// Searches every rule but the planner's once, each with the others as they are. `identified`: limits of the path before
/// any rule.
void search_rules(const PathLimits& identified, double least_gain, RuleScores& scores, Identification& result) {
    if (is_trapezoidal(result.machine)) {
        const Rule accelerations = axis_accelerations_rule(result);
        if (accelerations.values.size() > 1)
            search_rule(accelerations, present_value(accelerations, result.machine), least_gain, scores, result);
    }
    for (const auto& make : rules_of(result.machine, identified)) {
        const Rule rule = make(result.machine);
        search_rule(rule, present_value(rule, result.machine), least_gain, scores, result);
    }
}

/// The families, each with the kind that explains the runs best with the machine's other rules, and those families first
/// that explain them better.
std::vector<RuleValue> best_of_families(RuleScores& scores, const Machine& machine) {
    std::vector<std::pair<double, RuleValue>> best;
    for (const PlannerFamily& family : planner_families(machine)) {
        Identification trial;
        trial.machine = machine;
        search_rule(family.rule, family.present, 0, scores, trial);
        const auto kind =
            std::find_if(trial.rules.begin(), trial.rules.end(), [](const RuleCandidate& c) { return c.chosen; });
        best.emplace_back(kind->speed_error, family.rule.values[static_cast<std::size_t>(kind - trial.rules.begin())]);
    }
    std::stable_sort(best.begin(), best.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<RuleValue> values;
    for (auto& [error, value] : best) values.push_back(std::move(value));
    return values;
}

/// Compares the families, each with its own rules: with those of the machine, a wrong kind of planner may explain the runs
/// better than the right one with a wrong look-ahead. A family that explains the runs well is the last one. Returns the rows
/// of those that are not chosen.
std::vector<RuleCandidate> choose_family(RuleScores& scores, Identification& result) {
    std::vector<Identification> found;
    Rule planner{"planner", "controller", {}, {}};
    for (const RuleValue& kind : best_of_families(scores, result.machine)) {
        Identification trial = result;
        kind.apply(trial.machine);
        search_rules(result.machine.path, 0, scores, trial);
        const auto last =
            std::find_if(trial.rules.rbegin(), trial.rules.rend(), [](const RuleCandidate& c) { return c.chosen; });
        planner.values.push_back({kind.name, [machine = trial.machine](Machine& m) { m = machine; }});
        const bool explains_all = last->speed_error <= explained_share * scores.usual_speed();
        found.push_back(std::move(trial));
        if (explains_all) break;
    }
    Identification compared;
    compared.machine = result.machine;
    search_rule(planner, planner.values.size(), 0, scores, compared);
    const auto best =
        std::find_if(compared.rules.begin(), compared.rules.end(), [](const RuleCandidate& c) { return c.chosen; });
    result = std::move(found[static_cast<std::size_t>(best - compared.rules.begin())]);
    compared.rules.erase(best);
    return compared.rules;
}

/// Parameters of limits that the rules have changed.
void restate_accelerations(Identification& result) {
    for (IdentifiedParameter& p : result.parameters) {
        if (p.name != "max_acceleration") continue;
        if (p.axis == "path" && result.machine.path.max_acceleration == no_limit) p.note = "the axes alone limit it";
        const auto axis = std::find(axis_names.begin(), axis_names.end(), p.axis);
        if (axis == axis_names.end()) continue;
        const double now = result.machine.axes[static_cast<std::size_t>(axis - axis_names.begin())].max_acceleration;
        if (p.reached == false) p.note = fmt::format("hardly exceeded; the file has {:.6g}", now);
        if (p.reached == false || std::abs(now - 2 * p.value) > 0.01 * now) continue;
        p.value *= 2;
        if (p.standard_error) *p.standard_error *= 2;
        p.note += "; twice what blocks that overlap keep";
    }
}

}  // namespace

void identify_rules(std::span<const RecordedRun> runs, Identification& result) {
    RuleScores scores(runs);
    const PathLimits identified = result.machine.path;
    const std::vector<UnidentifiedParameter> known_missing = result.unidentified;
    const std::vector<RuleCandidate> other_families = choose_family(scores, result);
    // One rule may hide another: a short look-ahead slows short lines down, as a block time does.
    for (int pass = 1; pass < most_passes; ++pass) {
        const Machine before = result.machine;
        Identification next = result;
        next.rules.clear();
        next.unidentified = known_missing;
        const std::vector<PlannerFamily> families = planner_families(before);
        const auto own = std::find_if(families.begin(), families.end(), [](const auto& f) { return f.has_present(); });
        search_rule(own->rule, own->present, gain_of_later_passes, scores, next);
        search_rules(identified, gain_of_later_passes, scores, next);
        result = std::move(next);
        if (plan_alike(before, result.machine)) break;
    }
    result.rules.insert(result.rules.begin(), other_families.begin(), other_families.end());
    if (!is_trapezoidal(result.machine)) return;
    restate_accelerations(result);
    result.unidentified.push_back({"merging_tolerance", "controller", "a program sets it (Q of G64); not searched"});
}

}  // namespace clsurf

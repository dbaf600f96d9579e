#include "identify/planner_rules.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf {
namespace {

constexpr double decisive = 10;          // of the criterion: "very strong" evidence (Kass and Raftery 1995)
constexpr double no_limit = 1'000'000;   // mm/s²
constexpr PointIndex sample_every = 32;  // records

struct RuleValue {
    std::string name;
    std::function<void(Machine&)> apply;
};

struct Rule {
    std::string name, axis;
    std::vector<RuleValue> values;
};

bool is_trapezoidal(const Machine& machine) { return machine.controller.planner == PlannerKind::trapezoidal; }

/// A rule of numbers, the present one among them. `unit`: of the machine file, in ours.
template <typename Number, typename Member>
Rule rule_of_numbers(const char* name, const char* axis, const Machine& machine, std::vector<Number> numbers,
                     Member member, Number unit = 1) {
    Machine now = machine;
    const Number present = static_cast<Number>(member(now));
    if (std::find(numbers.begin(), numbers.end(), present) == numbers.end()) numbers.push_back(present);
    std::sort(numbers.begin(), numbers.end());
    Rule rule{name, axis, {}};
    for (const Number number : numbers)
        rule.values.push_back({fmt::format("{}", number / unit), [=](Machine& m) { member(m) = number; }});
    return rule;
}

Rule planner_rule() {
    const auto optimal = [](CornerMode corner) {
        return [corner](Machine& m) {
            m.controller.planner = PlannerKind::time_optimal;
            m.controller.corner = corner;
        };
    };
    const auto trapezoidal = [](bool arcs) {
        return [arcs](Machine& m) {
            m.controller.planner = PlannerKind::trapezoidal;
            m.controller.trapezoid.arc_blends = arcs;
            m.path.max_acceleration = m.path.max_normal_acceleration = no_limit;
            for (MachineAxis& axis : m.axes) axis.max_jerk = 0;
        };
    };
    return {"planner",
            "controller",
            {{"time-optimal, corner arc", optimal(CornerMode::arc)},
             {"time-optimal, corner spline", optimal(CornerMode::spline)},
             {"time-optimal, corner stop", optimal(CornerMode::stop)},
             {"trapezoidal, arc blends", trapezoidal(true)},
             {"trapezoidal, parabolic blends", trapezoidal(false)}}};
}

Rule path_acceleration_rule(const PathLimits& identified) {
    return {
        "max_acceleration",
        "path",
        {{"of the axes alone", [](Machine& m) { m.path.max_acceleration = m.path.max_normal_acceleration = no_limit; }},
         {fmt::format("{}, normal {}", identified.max_acceleration, identified.max_normal_acceleration),
          [identified](Machine& m) { m.path = identified; }}}};
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
    Rule rule{"max_acceleration", "x, y, z", {}};
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
             {"false", [](Machine& m) { m.controller.trapezoid.cubic_interpolation = false; }}}};
}

Rule curve_rule() {
    Rule rule{"curve", "controller", {}};
    for (const CurveMode mode : {CurveMode::none, CurveMode::akima, CurveMode::least_squares})
        rule.values.push_back({std::string(name_of(mode)), [mode](Machine& m) { m.controller.curve = mode; }});
    return rule;
}

/// The rules that a planner of this kind has; each is searched with the others as they were found before.
std::vector<std::function<Rule(const Machine&)>> rules_of(const Machine& machine, const PathLimits& identified) {
    std::vector<std::function<Rule(const Machine&)>> rules;
    rules.emplace_back([](const Machine& m) {
        return rule_of_numbers("tolerance", "controller", m, std::vector{0.002, 0.005, 0.01, 0.02, 0.05},
                               [](Machine& x) -> double& { return x.controller.tolerance; });
    });
    rules.emplace_back([](const Machine& m) {
        return rule_of_numbers("lookahead_blocks", "controller", m, std::vector{5, 20, 50, 200, 1000},
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
        rules.emplace_back([](const Machine&) { return curve_rule(); });
        rules.emplace_back([](const Machine& m) {
            return rule_of_numbers("block_time", "controller", m, std::vector{0.0, 0.001, 0.002, 0.005},
                                   [](Machine& x) -> double& { return x.controller.block_time; });
        });
        rules.emplace_back([](const Machine& m) {
            return rule_of_numbers("max_normal_acceleration", "path", m,
                                   std::vector{500.0, 1000.0, 1500.0, 2000.0, 4000.0},
                                   [](Machine& x) -> double& { return x.path.max_normal_acceleration; });
        });
    }
    return rules;
}

/// Scores machines against the runs.
class RuleScores {
public:
    explicit RuleScores(std::span<const RecordedRun> runs) {
        constexpr PointIndex most = 200'000;
        for (const RecordedRun& run : runs) runs_.push_back(&run);
        std::stable_sort(runs_.begin(), runs_.end(),
                         [](const auto* a, const auto* b) { return a->part().log.records < b->part().log.records; });
        PointIndex sum = 0;
        const auto beyond = std::find_if(runs_.begin() + 1, runs_.end(), [&](const RecordedRun* run) {
            sum += run->part().log.records;
            return sum + runs_.front()->part().log.records > most;
        });
        runs_.erase(beyond, runs_.end());
    }

    /// |difference of speed| at every sample [mm/s]; NaN: not compared.
    [[nodiscard]] std::vector<float> residuals(const Machine& machine) {
        std::vector<float> all;
        for (const RecordedRun* run : runs_) {
            const RunDifferences found = run->differences(run->simulated(machine));
            usual_speed_ = std::max(usual_speed_, found.usual_speed);
            const Column<float>& speed = found.of[index_of(RunQuantity::speed)];
            for (std::size_t i = 0; i < speed.size(); i += sample_every) all.push_back(std::abs(speed[i]));
        }
        return all;
    }
    /// The speed that a place counts as wrong by where the simulation does not go there [mm/s].
    [[nodiscard]] double usual_speed() const { return static_cast<double>(usual_speed_); }

private:
    std::vector<const RecordedRun*> runs_;
    float usual_speed_ = 0;
};

/// Scores of candidates over the samples that any of them has.
void score(const std::vector<std::vector<float>>& residuals, double usual_speed, std::span<RuleCandidate> candidates) {
    constexpr double of_positions = 0.005;   // mm/s: differences of rounded positions are no better …
    constexpr double of_the_model = 0.0005;  // … nor is any model, of the speed
    const double resolution = std::max(of_positions, of_the_model * usual_speed);
    std::vector<double> sums(residuals.size(), 0);
    std::size_t samples = 0;
    for (std::size_t i = 0; i < residuals.front().size(); ++i) {
        if (std::all_of(residuals.begin(), residuals.end(), [&](const auto& r) { return std::isnan(r[i]); })) continue;
        ++samples;
        for (std::size_t k = 0; k < residuals.size(); ++k)
            sums[k] += std::isnan(residuals[k][i]) ? usual_speed : static_cast<double>(residuals[k][i]);
    }
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        const auto n = static_cast<double>(samples);
        candidates[k].speed_error = samples > 0 ? sums[k] / n : 0;
        candidates[k].score = 2 * n * std::log(std::max(candidates[k].speed_error, resolution));
    }
}

/// The candidates that the runs explain about as well as the best one.
std::vector<std::size_t> equal_to_best(std::span<const RuleCandidate> candidates) {
    double best = std::numeric_limits<double>::infinity();
    for (const RuleCandidate& c : candidates) best = std::min(best, c.score);
    std::vector<std::size_t> equal;
    for (std::size_t k = 0; k < candidates.size(); ++k)
        if (candidates[k].score <= best + decisive) equal.push_back(k);
    return equal;
}

/// Searches one rule; `present`: the index of the value that the machine has, size() where it has none of them.
void search(const Rule& rule, std::size_t present, RuleScores& scores, Identification& result) {
    std::vector<RuleCandidate> candidates;
    std::vector<std::vector<float>> residuals;
    for (const RuleValue& value : rule.values) {
        Machine machine = result.machine;
        value.apply(machine);
        residuals.push_back(scores.residuals(machine));
        candidates.push_back({.rule = rule.name, .value = value.name, .axis = rule.axis});
    }
    score(residuals, scores.usual_speed(), candidates);
    const std::vector<std::size_t> equal = equal_to_best(candidates);
    const bool keeps = std::find(equal.begin(), equal.end(), present) != equal.end();
    const std::size_t chosen =
        keeps ? present : *std::min_element(equal.begin(), equal.end(), [&](std::size_t a, std::size_t b) {
            return candidates[a].score < candidates[b].score;
        });
    candidates[chosen].chosen = true;
    for (const std::size_t k : equal) candidates[k].equal = true;
    rule.values[chosen].apply(result.machine);
    if (equal.size() > 1) {
        std::vector<std::string> names;
        for (const std::size_t k : equal) names.push_back(rule.values[k].name);
        result.unidentified.push_back(
            {rule.name, rule.axis,
             fmt::format("the runs do not tell apart {}; kept {}", fmt::join(names, "; "), rule.values[chosen].name)});
    }
    std::move(candidates.begin(), candidates.end(), std::back_inserter(result.rules));
}

std::size_t present_planner(const Machine& machine) {
    if (is_trapezoidal(machine)) return machine.controller.trapezoid.arc_blends ? 3 : 4;
    return machine.controller.corner == CornerMode::arc ? 0 : machine.controller.corner == CornerMode::spline ? 1 : 2;
}

/// The value that leaves the machine's rule as it is.
std::size_t present_value(const Rule& rule, const Machine& machine) {
    const auto same = [&](const RuleValue& value) {
        Machine changed = machine;
        value.apply(changed);
        const ControllerSettings &a = machine.controller, &b = changed.controller;
        return a.tolerance == b.tolerance && a.lookahead_blocks == b.lookahead_blocks && a.curve == b.curve &&
               a.block_time == b.block_time && a.trapezoid.cubic_interpolation == b.trapezoid.cubic_interpolation &&
               a.trapezoid.max_feed_override == b.trapezoid.max_feed_override &&
               a.trapezoid.blocks_per_period == b.trapezoid.blocks_per_period &&
               std::equal(machine.axes.begin(), machine.axes.end(), changed.axes.begin(),
                          [](const MachineAxis& x, const MachineAxis& y) {
                              return x.max_acceleration == y.max_acceleration;
                          }) &&
               machine.path.max_acceleration == changed.path.max_acceleration &&
               machine.path.max_normal_acceleration == changed.path.max_normal_acceleration;
    };
    return static_cast<std::size_t>(std::find_if(rule.values.begin(), rule.values.end(), same) - rule.values.begin());
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
    search(planner_rule(), present_planner(result.machine), scores, result);
    if (is_trapezoidal(result.machine)) {
        const Rule accelerations = axis_accelerations_rule(result);
        if (accelerations.values.size() > 1) search(accelerations, 0, scores, result);
    }
    for (const auto& make : rules_of(result.machine, identified)) {
        const Rule rule = make(result.machine);
        search(rule, present_value(rule, result.machine), scores, result);
    }
    if (is_trapezoidal(result.machine)) restate_accelerations(result);
    result.unidentified.push_back({"merging_tolerance", "controller", "a program sets it (Q of G64); not searched"});
}

}  // namespace clsurf

#include "identify/planner_rules.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "identify/rule_list.h"
#include "identify/rule_search.h"
#include "identify/simulated_limits.h"
#include "machine/planning_value.h"

namespace clsurf {
namespace {

constexpr int most_passes = 4;  // over all rules
// gain_of_later_passes: docs/design/identify.md#rules-of-the-planner. With less, a run was explained by a look-ahead of 5
// blocks that missed the time of another part by 3 %.
constexpr double gain_of_later_passes = 0.25;  // share of the speed error: these passes correct what other rules hid

/// The value that leaves the rule of the machine unchanged.
std::size_t present_value(const Rule& rule, const Machine& machine) {
    const auto same = [&](const RuleValue& value) {
        Machine changed = machine;
        value.apply(changed);
        return plan_alike(machine, changed);
    };
    return static_cast<std::size_t>(std::find_if(rule.values.begin(), rule.values.end(), same) - rule.values.begin());
}

/// Rejects a value that explains the runs better but not well. If all merging tolerances are wrong, or other rules are
/// wrong, one value is always the best by chance. `before`: with the present value.
void refuse_half_right(const Rule& rule, std::size_t present, const Machine& before, const RuleScores& scores,
                       Identification& result) {
    const auto rows = result.rules.end() - static_cast<std::ptrdiff_t>(rule.values.size());
    const auto best = std::find_if(rows, result.rules.end(), [](const RuleCandidate& c) { return c.chosen; });
    if (best - rows == static_cast<std::ptrdiff_t>(present) || scores.explains(best->speed_error)) return;
    best->chosen = false;
    rows[static_cast<std::ptrdiff_t>(present)].chosen = true;
    result.machine = before;
    result.unidentified.push_back(
        {rule.name, rule.axis, "no value explains the runs; kept " + rule.values[present].name});
}

/// The machine with the merging of lines that was known before any search; with another planner it is unknown.
Machine with_known_merging(Machine machine, const Machine& known) {
    const bool same = known.controller.planner == machine.controller.planner;
    machine.controller.merging_tolerance = same ? known.controller.merging_tolerance : std::nullopt;
    return machine;
}

/// Searches the merging of lines. A slightly different merging may compensate for a slightly wrong limit. Therefore a new
/// value must always explain clearly more than the value known before any search.
void search_merging(const Rule& rule, const Machine& known, RuleScores& scores, Identification& result) {
    result.machine = with_known_merging(result.machine, known);
    const Machine before = result.machine;
    const std::size_t present = present_value(rule, before);
    search_rule(rule, present, gain_of_later_passes, scores, result);
    refuse_half_right(rule, present, before, scores, result);
}

/// Searches every rule except the planner's once, with the others unchanged. `known`: the machine before any rule, with the
/// limits that the motion shows.
void search_rules(const Machine& known, double least_gain, RuleScores& scores, Identification& result) {
    if (is_trapezoidal(result.machine)) {
        const bool some_overlap = !scores.explains(scores.mean_error(result.machine));
        const Rule accelerations = axis_accelerations_rule(some_overlap, result);
        if (accelerations.values.size() > 1)
            search_rule(accelerations, present_value(accelerations, result.machine), least_gain, scores, result);
    }
    for (const auto& make : rules_of(result.machine, known.path)) {
        const Rule rule = make(result.machine);
        if (rule.name == "merging_tolerance")
            search_merging(rule, known, scores, result);
        else
            search_rule(rule, present_value(rule, result.machine), least_gain, scores, result);
    }
}

/// Removes a merging of lines if other limits explain the runs about as well without it.
void confirm_merging(const Machine& known, RuleScores& scores, Identification& result) {
    Identification other = result;
    other.machine = with_known_merging(result.machine, known);
    if (plan_alike(other.machine, result.machine)) return;
    free_limits(scores, other);
    search_limits(0, scores, other);
    if (scores.mean_error(result.machine) <= (1 - gain_of_later_passes) * scores.mean_error(other.machine)) return;
    const double kept = other.machine.controller.merging_tolerance.value_or(0);
    const std::string name = is_trapezoidal(other.machine) && !other.machine.controller.merging_tolerance
                                 ? "program"
                                 : fmt::format("{:.6g}", kept);
    for (RuleCandidate& row : result.rules) {
        if (row.rule == "merging_tolerance") row.chosen = row.value == name;
    }
    result.machine = other.machine;
    result.unidentified.push_back(
        {"merging_tolerance", "controller", "other limits explain the runs as well without it; kept " + name});
}

/// For each family, the kind that explains the runs best with the machine's other rules. Families that explain the runs
/// better come first.
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

/// Compares the families, each with its own rules: with the machine's rules, a wrong kind of planner may explain the runs
/// better than the right one with a wrong look-ahead. The comparison ends at a family that explains the runs well. Returns
/// the rows of the families that are not chosen.
std::vector<RuleCandidate> choose_family(RuleScores& scores, Identification& result) {
    const Machine known = result.machine;
    std::vector<Identification> found;
    Rule planner{"planner", "controller", {}, {}};
    for (const RuleValue& kind : best_of_families(scores, result.machine)) {
        Identification trial = result;
        kind.apply(trial.machine);
        free_limits(scores, trial);
        search_rules(known, 0, scores, trial);
        const auto last =
            std::find_if(trial.rules.rbegin(), trial.rules.rend(), [](const RuleCandidate& c) { return c.chosen; });
        planner.values.push_back({kind.name, [machine = trial.machine](Machine& m) { m = machine; }});
        const bool explains_all = scores.explains(last->speed_error);
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

/// Puts the machine's value into the note of a lower bound.
void restate_value_of_file(IdentifiedParameter& p, double now) {
    constexpr std::string_view words = "; the file has ";
    if (const std::size_t at = p.note.find(words); at != std::string::npos)
        p.note.replace(at + words.size(), std::string::npos, fmt::format("{:.6g}", now));
}

/// Updates the parameters of limits that the searches have changed.
void restate_limits(Identification& result) {
    for (IdentifiedParameter& p : result.parameters) {
        if (p.name == "max_speed" && p.reached == false) {
            if (const auto now = planning_value(result.machine, p.name, p.axis)) restate_value_of_file(p, *now);
        }
        if (p.name != "max_acceleration") continue;
        if (p.axis == "path" && result.machine.path.max_acceleration == no_path_limit) {
            p.note = "the axes alone limit it";
            if (p.reached) p.reached = false;
            p.standard_error.reset();
        }
        const auto axis = std::find(axis_names.begin(), axis_names.end(), p.axis);
        if (axis == axis_names.end()) continue;
        const double now = result.machine.axes[static_cast<std::size_t>(axis - axis_names.begin())].max_acceleration;
        if (p.reached == false) restate_value_of_file(p, now);
        if (p.reached == false || std::abs(now - 2 * p.value) > 0.01 * now) continue;
        p.value *= 2;
        if (p.standard_error) *p.standard_error *= 2;
        p.note += "; twice what blocks that overlap keep";
    }
}

}  // namespace

bool identify_rules(std::span<const RecordedRun> runs, Identification& result) {
    RuleScores scores(runs);
    const Identification before_search = result;
    const Machine& known = before_search.machine;
    const std::vector<UnidentifiedParameter>& known_missing = before_search.unidentified;
    const std::vector<RuleCandidate> other_families = choose_family(scores, result);
    if (!scores.has_compared()) {
        result = before_search;
        return false;
    }
    search_limits(0, scores, result);
    // One rule may hide another: a short look-ahead slows short lines, as a block time does.
    for (int pass = 1; pass < most_passes; ++pass) {
        const Machine before = result.machine;
        if (pass > 1 && scores.mean_error(before) <= scores.resolution()) break;
        Identification next = result;
        next.rules.clear();
        next.unidentified = known_missing;
        const std::vector<PlannerFamily> families = planner_families(before);
        const auto own = std::find_if(families.begin(), families.end(), [](const auto& f) { return f.has_present(); });
        search_rule(own->rule, own->present, gain_of_later_passes, scores, next);
        free_limits(scores, next);
        search_rules(known, gain_of_later_passes, scores, next);
        search_limits(gain_of_later_passes, scores, next);
        result = std::move(next);
        if (plan_alike(before, result.machine)) break;
    }
    confirm_merging(known, scores, result);
    result.rules.insert(result.rules.begin(), other_families.begin(), other_families.end());
    for (const auto& [name, reason] : omitted_rules(result.machine))
        result.unidentified.push_back({name, "controller", reason});
    const std::vector<SimulatedLimit> limits = limit_intervals(scores, result);
    if (is_trapezoidal(result.machine)) restate_limits(result);
    state_limits(limits, result);
    return true;
}

}  // namespace clsurf

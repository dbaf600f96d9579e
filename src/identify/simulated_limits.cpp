#include "identify/simulated_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include "core/units.h"
#include "identify/rule_list.h"
#include "machine/planning_value.h"

namespace clsurf {
namespace {

constexpr std::string_view speed_key = "max_speed";
constexpr int most_rounds = 3;       ///< over all limits, because the lowest limit hides the others
constexpr double value_step = 0.02;  ///< relative distance of adjacent values
// range, about_best: docs/design/identify.md#limits-that-the-motion-hides.
constexpr double range = 4;                 ///< factor of the machine's value up to which values are tried
constexpr std::size_t grid = 6;             ///< number of these values, in equal ratios
constexpr int bits = 10;                    ///< accuracy of the logarithm of the best value …
constexpr std::uintmax_t most_steps = 12;   ///< … or most steps
constexpr double about_best = 0.05;         ///< relative range in which round values are tried …
constexpr double round_steps = 20;          ///< … at a twentieth of the first digit
constexpr double first_share = 0.0025;      ///< relative step at which a search for the ends of its interval begins
constexpr double share_of_interval = 0.25;  ///< relative accuracy of the ends …
constexpr double finest = 1e-4;             ///< … or this share of the value
constexpr double widest = 0.25;    ///< greatest relative distance to either end of an interval that determines a value
constexpr double correlation = 2;  ///< factor of standard errors: differences of speed are correlated over samples
constexpr double smallest_error = 5e-4;  ///< least relative standard error: planners stay that far below their limits

/// One limit, with all other values of the machine fixed.
class LimitSlice {
public:
    LimitSlice(RuleScores& scores, const Machine& machine, std::string key, std::string of)
        : scores_(scores), machine_(machine), key_(std::move(key)), of_(std::move(of)) {}

    /// The value that explains the runs best, or `now`, the machine's value, if it is nearly as good. `lowest`: the least
    /// value that the motion allows.
    [[nodiscard]] double best(double lowest, double now, double least_gain) const {
        const double greatest = highest_tried(lowest, now);
        if (mean_error(now) <= scores_.resolution()) return now;
        prepare({lowest, greatest});
        if (alike(lowest, now) && alike(greatest, now)) return now;
        prepare({below(now), above(now)});
        const double was = mean_error(now);
        if (is_flat_about(now) && scores_.explains(was)) return now;
        double best = lowest_in(bracket(lowest, greatest, now), now);
        // The best value near the present one may be a local optimum.
        for (const double end : {lowest, greatest}) {
            if (mean_error(end) < mean_error(best)) best = end;
        }
        if (mean_error(best) > scores_.resolution())
            best = best_of(round_values(best / (1 + about_best), best * (1 + about_best)), best);
        const double is = mean_error(best);
        // If the model differs from the machine, a limit may compensate for other errors.
        return !as_good(now, best) && (is <= (1 - least_gain) * was || scores_.explains(is)) ? best : now;
    }

    /// The values around the best one that the runs cannot distinguish from it. `exact`: accuracy of the ends that is
    /// sufficient, as a share of the value.
    [[nodiscard]] SimulatedLimit interval(double lowest, double best, double exact) const {
        SimulatedLimit found{key_, of_, best, {}, {}, scores_.explains(mean_error(best))};
        const double greatest = highest_tried(lowest, best);
        if (lowest < best && beyond_doubt(lowest, best) > 0) found.lowest = end_between(lowest, best, exact);
        if (beyond_doubt(greatest, best) > 0) found.highest = end_between(greatest, best, exact);
        found.exact = mean_error(best) <= scores_.resolution();
        if (found.exact && found.highest)
            found.best = best_of(round_values(found.lowest.value_or(lowest), *found.highest), best);
        return found;
    }

private:
    [[nodiscard]] static double highest_tried(double lowest, double now) { return range * std::max(now, lowest); }
    [[nodiscard]] static double below(double value) { return value / (1 + value_step); }
    [[nodiscard]] static double above(double value) { return value * (1 + value_step); }

    /// Simulates the values, in parallel.
    void prepare(const std::vector<double>& values) const {
        std::vector<Machine> machines;
        for (const double value : values) machines.push_back(machine_with(value));
        scores_.prepare(machines);
    }

    [[nodiscard]] Machine machine_with(double value) const {
        Machine changed = machine_;
        set_planning_value(changed, key_, of_, value);
        return changed;
    }

    [[nodiscard]] double mean_error(double value) const { return scores_.mean_error(machine_with(value)); }

    /// The excess of the score of `value` over the difference that distinguishes it from a better one.
    [[nodiscard]] double excess(double value, double better) const {
        const std::vector<Explanation> pair =
            compare({scores_.residuals(machine_with(value)), scores_.residuals(machine_with(better))}, scores_);
        return pair[0].score - pair[1].score - decisive;
    }
    [[nodiscard]] bool as_good(double value, double better) const { return excess(value, better) <= 0; }
    [[nodiscard]] bool alike(double one, double other) const { return as_good(one, other) && as_good(other, one); }

    /// Whether slightly smaller and slightly greater values fit the runs as well.
    [[nodiscard]] bool is_flat_about(double now) const {
        return mean_error(now) <= scores_.resolution() || (alike(below(now), now) && alike(above(now), now));
    }

    /// Two values that enclose the one with the least mean error.
    [[nodiscard]] std::pair<double, double> bracket(double lowest, double greatest, double now) const {
        if (is_flat_about(now)) return bracket_of_grid(lowest, greatest, now);
        const double was = mean_error(now), lower = mean_error(below(now)), higher = mean_error(above(now));
        if (lower >= was && higher >= was) return {below(now), above(now)};
        const bool falls = lower < higher;
        double from = now, to = falls ? below(now) : above(now), ratio = falls ? below(1) : above(1);
        for (double error = std::min(lower, higher); to > lowest && to < greatest;) {
            ratio *= ratio;
            const double next = std::clamp(to * ratio, lowest, greatest), next_error = mean_error(next);
            if (next_error > error) return std::minmax({from, next});
            from = std::exchange(to, next);
            error = next_error;
        }
        return std::minmax({from, to});
    }

    /// The same if values near `now` are equally good, so that there is no direction of descent.
    [[nodiscard]] std::pair<double, double> bracket_of_grid(double lowest, double greatest, double now) const {
        std::vector<double> values{now};
        for (std::size_t k = 0; k < grid; ++k)
            values.push_back(lowest * std::pow(greatest / lowest, static_cast<double>(k) / (grid - 1)));
        std::sort(values.begin(), values.end());
        prepare(values);
        const auto least = std::min_element(values.begin(), values.end(),
                                            [&](double a, double b) { return mean_error(a) < mean_error(b); });
        const auto k = static_cast<std::size_t>(least - values.begin());
        return {values[k > 0 ? k - 1 : 0], values[std::min(k + 1, values.size() - 1)]};
    }

    [[nodiscard]] double lowest_in(std::pair<double, double> bracket, double now) const {
        std::uintmax_t steps = most_steps;
        const auto [share, error] = boost::math::tools::brent_find_minima(
            [&](double log_share) { return mean_error(now * std::exp(log_share)); }, std::log(bracket.first / now),
            std::log(bracket.second / now), bits, steps);
        return now * std::exp(share);
    }

    /// The round values from `lowest` to `highest`, for a trapezoidal planner. Its motion changes by whole periods. Therefore
    /// the mean error has many minima near the true value, and people choose round values. Empty for other planners.
    [[nodiscard]] std::vector<double> round_values(double lowest, double highest) const {
        std::vector<double> values;
        if (!is_trapezoidal(machine_)) return values;
        const auto add_multiples_of = [&](double step) {
            for (double k = std::ceil(lowest / step); k * step <= highest; ++k) values.push_back(k * step);
        };
        add_multiples_of(std::pow(10, std::floor(std::log10(highest))) / round_steps);
        if (key_ == speed_key) add_multiples_of(seconds_per_minute);
        return values;
    }

    /// The one of `values` that explains the runs best, or `best`.
    [[nodiscard]] double best_of(const std::vector<double>& values, double best) const {
        prepare(values);
        for (const double value : values) {
            if (mean_error(value) < mean_error(best)) best = value;
        }
        return best;
    }

    /// Above 0 if a value cannot be the true one. What the best value leaves unexplained has other causes, which may also
    /// have moved the best value: the error of `value` must also exceed the least error by as much.
    [[nodiscard]] double beyond_doubt(double value, double best) const {
        const double left = mean_error(best), resolution = scores_.resolution();
        const double other = std::sqrt(std::max(0.0, left * left - resolution * resolution));
        return std::min(excess(value, best) / decisive, mean_error(value) / (left + other) - 1);
    }

    /// The end of the interval of values that explain the runs as well as the best one, towards `worse`, a value that does
    /// not.
    [[nodiscard]] double end_between(double worse, double best, double exact) const {
        const auto beyond = [&](double share) {
            const double value = worse > best ? best * (1 + share) : best / (1 + share);
            return worse > best ? std::min(value, worse) : std::max(value, worse);
        };
        double share = std::max(first_share, exact), good = best, bad = beyond(share);
        while (bad != worse && beyond_doubt(bad, best) <= 0) {
            good = bad;
            share *= 2;
            bad = beyond(share);
        }
        if (good == best && share <= exact) return bad;
        const auto near_enough = [&](double a, double b) {
            return std::abs(a - b) <= std::max(share_of_interval * std::abs(a - best), finest * best);
        };
        std::uintmax_t steps = most_steps;
        const auto [low, high] =
            boost::math::tools::toms748_solve([&](double value) { return beyond_doubt(value, best); },
                                              std::min(good, bad), std::max(good, bad), near_enough, steps);
        return worse < best ? low : high;
    }

    RuleScores& scores_;
    const Machine& machine_;
    std::string key_, of_;
};

/// Whether the runs have arcs that show the highest speeds of the axes. A trapezoidal planner gives an arc the tangential
/// acceleration that remains at the highest speed of its axes.
bool arcs_depend_on_speeds(const RuleScores& scores, const Machine& machine) {
    return is_trapezoidal(machine) && scores.has_arcs();
}

/// Limits of the machine that are lower bounds, if the speeds of the runs may depend on them. On paths other than arcs,
/// limits of speed have an effect in rapids only.
std::vector<const IdentifiedParameter*> searched_limits(const RuleScores& scores, const Identification& result) {
    std::vector<const IdentifiedParameter*> limits;
    if (result.machine.kinematics.has_rotary()) return limits;
    const bool arcs_tell = arcs_depend_on_speeds(scores, result.machine);
    for (const IdentifiedParameter& p : result.parameters) {
        const std::optional<double> now = planning_value(result.machine, p.name, p.axis);
        const bool unlimited = p.axis == "path" && now >= no_path_limit;
        const bool held_in_rapids_alone = p.name == speed_key && (!arcs_tell || p.axis == "path");
        if (p.reached == false && p.value > 0 && now > 0.0 && !unlimited && !held_in_rapids_alone) limits.push_back(&p);
    }
    return limits;
}

/// The relative error of every slice: a slice assumes that the other limits are right, and a slightly wrong limit shifts it.
double error_of_fixed(const Identification& result) {
    double error = smallest_error;
    for (const IdentifiedParameter& p : result.parameters) {
        if (p.reached == true && p.standard_error) error = std::max(error, *p.standard_error / p.value);
    }
    return error;
}

/// The machine with all limits of the list multiplied by `factor`.
Machine with_limits(const Machine& machine, std::span<const IdentifiedParameter* const> limits, double factor) {
    Machine changed = machine;
    for (const IdentifiedParameter* p : limits) {
        const double now = *planning_value(machine, p->name, p->axis);
        set_planning_value(changed, p->name, p->axis, factor * std::max(now, p->value));
    }
    return changed;
}

/// The value of a limit that explains the runs best, with all other values of `machine` unchanged.
double best_value(const IdentifiedParameter& limit, const Machine& machine, double least_gain, RuleScores& scores) {
    const double now = *planning_value(machine, limit.name, limit.axis);
    return LimitSlice(scores, machine, limit.name, limit.axis).best(std::min(limit.value, now), now, least_gain);
}

/// Searches the highest speeds of the axes, each with the others unchanged: the slower axis of its plane limits an arc. If
/// the runs do not show which axis that is, all possible ones get their values.
void search_speeds_of_arcs(std::span<const IdentifiedParameter* const> limits, double least_gain, RuleScores& scores,
                           Machine& machine) {
    std::vector<const IdentifiedParameter*> found;
    std::vector<double> values;
    std::vector<std::vector<float>> residuals;
    for (const IdentifiedParameter* p : limits) {
        if (p->name != speed_key) continue;
        const double value = best_value(*p, machine, least_gain, scores);
        if (value == *planning_value(machine, p->name, p->axis)) continue;
        Machine changed = machine;
        set_planning_value(changed, p->name, p->axis, value);
        found.push_back(p);
        values.push_back(value);
        residuals.push_back(scores.residuals(changed));
    }
    if (found.empty()) return;
    const std::vector<Explanation> explained = compare(residuals, scores);
    const double best = std::min_element(explained.begin(), explained.end(), [](const auto& a, const auto& b) {
                            return a.score < b.score;
                        })->score;
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (explained[k].score <= best + decisive)
            set_planning_value(machine, found[k]->name, found[k]->axis, values[k]);
    }
}

/// On an arc either may compensate for the other, so the limits that are searched first may end at wrong values.
enum class SearchedFirst : std::uint8_t { speeds, accelerations };

void search_limits_in_order(SearchedFirst first, double least_gain, RuleScores& scores, Identification& result) {
    for (int round = 0; round < most_rounds; ++round) {
        const Machine before = result.machine;
        const std::vector<const IdentifiedParameter*> limits = searched_limits(scores, result);
        if (first == SearchedFirst::speeds) search_speeds_of_arcs(limits, least_gain, scores, result.machine);
        for (const IdentifiedParameter* p : limits) {
            if (p->name == speed_key) continue;
            const double value = best_value(*p, result.machine, least_gain, scores);
            set_planning_value(result.machine, p->name, p->axis, value);
        }
        if (first == SearchedFirst::accelerations) search_speeds_of_arcs(limits, least_gain, scores, result.machine);
        if (plan_alike(before, result.machine)) return;
    }
}

}  // namespace

void free_limits(RuleScores& scores, Identification& result) {
    if (is_trapezoidal(result.machine)) return;
    const std::vector<const IdentifiedParameter*> limits = searched_limits(scores, result);
    std::vector<const IdentifiedParameter*> of_path;
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(of_path),
                 [](const auto* p) { return p->axis == "path"; });
    const Machine before = result.machine;
    if (limits.empty() || scores.mean_error(before) <= scores.resolution()) return;
    std::vector<Machine> machines{before, with_limits(before, limits, range)};
    if (!of_path.empty() && of_path.size() < limits.size()) machines.push_back(with_limits(before, of_path, range));
    scores.prepare(machines);
    std::vector<std::vector<float>> residuals;
    for (const Machine& machine : machines) residuals.push_back(scores.residuals(machine));
    const std::vector<Explanation> found = compare(residuals, scores);
    const auto best = std::min_element(found.begin(), found.end(),
                                       [](const Explanation& a, const Explanation& b) { return a.score < b.score; });
    if (best->score > found.front().score - decisive) return;
    result.machine = machines[static_cast<std::size_t>(best - found.begin())];
    // Limits that had no effect keep their values.
    for (const IdentifiedParameter* p : limits) {
        Machine kept = result.machine;
        set_planning_value(kept, p->name, p->axis, *planning_value(before, p->name, p->axis));
        const std::vector<Explanation> pair =
            compare({scores.residuals(kept), scores.residuals(result.machine)}, scores);
        if (pair[0].score <= pair[1].score) result.machine = kept;
    }
}

void search_limits(double least_gain, RuleScores& scores, Identification& result) {
    const Identification before = result;
    search_limits_in_order(SearchedFirst::speeds, least_gain, scores, result);
    const double error = scores.mean_error(result.machine);
    if (!arcs_depend_on_speeds(scores, result.machine) || error <= scores.resolution()) return;
    Identification other = before;
    search_limits_in_order(SearchedFirst::accelerations, least_gain, scores, other);
    if (scores.mean_error(other.machine) < error) result = std::move(other);
}

std::vector<SimulatedLimit> limit_intervals(RuleScores& scores, const Identification& result) {
    std::vector<SimulatedLimit> limits;
    // Ends are not needed more accurately than the error from the other limits.
    const double exact = error_of_fixed(result) * std::sqrt(decisive) / correlation;
    for (const IdentifiedParameter* p : searched_limits(scores, result)) {
        const double now = *planning_value(result.machine, p->name, p->axis);
        limits.push_back(
            LimitSlice(scores, result.machine, p->name, p->axis).interval(std::min(p->value, now), now, exact));
    }
    return limits;
}

void state_limits(const std::vector<SimulatedLimit>& limits, Identification& result) {
    const double fixed_errors = error_of_fixed(result);
    for (const SimulatedLimit& limit : limits) {
        const auto p = std::find_if(result.parameters.begin(), result.parameters.end(),
                                    [&](const auto& each) { return each.name == limit.key && each.axis == limit.of; });
        const double shown = p->value;
        // No simulation is needed below the values of the recorded motion.
        const double farther =
            std::max(limit.best - limit.lowest.value_or(shown), limit.highest.value_or(INFINITY) - limit.best);
        if (limit.explains && (limit.lowest || limit.exact) && farther <= widest * limit.best) {
            // At √10 standard errors the criterion of independent samples rises by 10.
            const double error = std::max(correlation * farther / std::sqrt(decisive), fixed_errors * limit.best);
            p->value = std::max(rounded_to(limit.best, error), shown);
            p->standard_error = error;
            p->reached = true;
            const double above = rounded_to(*limit.highest, error);
            p->note = limit.lowest
                          ? fmt::format("simulations with {:.6g} and {:.6g} explain the runs less well",
                                        rounded_to(*limit.lowest, error), above)
                          : fmt::format("the motion shows {:.6g}; simulations with {:.6g} explain the runs less well",
                                        shown, above);
            set_planning_value(result.machine, limit.key, limit.of, p->value);
        } else if (limit.lowest && *limit.lowest > p->value) {
            p->value = rounded_to(*limit.lowest, finest * *limit.lowest);
            p->shown = p->value;
            p->note = fmt::format("simulations with less explain the runs less well; the file has {:.6g}", limit.best);
        }
    }
}

}  // namespace clsurf

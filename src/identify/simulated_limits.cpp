#include "identify/simulated_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include "identify/rule_list.h"
#include "machine/planning_value.h"

namespace clsurf {
namespace {

constexpr int most_rounds = 3;              ///< over all limits: the lowest one hides the others
constexpr double beside = 0.02;             ///< a share, of values beside another one
constexpr double range = 4;                 ///< of the machine's value, up to which others are tried
constexpr std::size_t grid = 6;             ///< values of it, in equal ratios
constexpr int bits = 10;                    ///< of the logarithm of the best value …
constexpr std::uintmax_t most_steps = 12;   ///< … or so many steps
constexpr double first_share = 0.0025;      ///< of it, by which a search for the ends of its interval begins
constexpr double share_of_interval = 0.25;  ///< to which they are known …
constexpr double finest = 1e-4;             ///< … or to this share of the value
constexpr double correlation = 2;           ///< of standard errors: differences of speed last for several samples
constexpr double smallest_error = 5e-4;     ///< standard, a share: planners stay that far below their limits

/// One limit, with all other values of the machine fixed.
class LimitSlice {
public:
    LimitSlice(RuleScores& scores, const Machine& machine, std::string key, std::string of)
        : scores_(scores), machine_(machine), key_(std::move(key)), of_(std::move(of)) {}

    /// The value that explains the runs best, or `now`, that of the machine, if it is nearly as good. `lowest`: the least value
    /// that the motion allows.
    [[nodiscard]] double best(double lowest, double now, double least_gain) const {
        const double greatest = highest_tried(lowest, now);
        prepare({now, lowest, greatest});
        if (alike(lowest, now) && alike(greatest, now)) return now;
        prepare({below(now), above(now)});
        const double was = mean_error(now);
        if (is_flat_about(now) && scores_.explains(was)) return now;
        const double best = lowest_in(bracket(lowest, greatest, now), now);
        const double is = mean_error(best);
        // Where the model is not the machine's, a limit may stand for what else is wrong.
        return !as_good(now, best) && (is <= (1 - least_gain) * was || scores_.explains(is)) ? best : now;
    }

    /// The values around the best one that the runs cannot distinguish from it.
    [[nodiscard]] SimulatedLimit interval(double lowest, double best) const {
        SimulatedLimit found{key_, of_, best, {}, {}, scores_.explains(mean_error(best))};
        const double greatest = highest_tried(lowest, best);
        if (lowest < best && !as_good(lowest, best)) found.lowest = end_between(lowest, best);
        if (!as_good(greatest, best)) found.highest = end_between(greatest, best);
        return found;
    }

private:
    [[nodiscard]] static double highest_tried(double lowest, double now) { return range * std::max(now, lowest); }
    [[nodiscard]] static double below(double value) { return value / (1 + beside); }
    [[nodiscard]] static double above(double value) { return value * (1 + beside); }

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

    [[nodiscard]] double mean_error(double value) const {
        return compare({scores_.residuals(machine_with(value))}, scores_).front().speed_error;
    }

    /// By how much the score of `value` exceeds what would tell it from one that explains the runs better.
    [[nodiscard]] double excess(double value, double better) const {
        const std::vector<Explanation> pair =
            compare({scores_.residuals(machine_with(value)), scores_.residuals(machine_with(better))}, scores_);
        return pair[0].score - pair[1].score - decisive;
    }
    [[nodiscard]] bool as_good(double value, double better) const { return excess(value, better) <= 0; }
    [[nodiscard]] bool alike(double one, double other) const { return as_good(one, other) && as_good(other, one); }

    /// Whether the runs cannot distinguish a value from those beside it.
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

    /// The same, if the values beside `now` are equally good and show no direction.
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

    /// Where values begin to explain the runs less well than the best one, on the way to `worse`, which does.
    [[nodiscard]] double end_between(double worse, double best) const {
        const auto beyond = [&](double share) {
            const double value = worse > best ? best * (1 + share) : best / (1 + share);
            return worse > best ? std::min(value, worse) : std::max(value, worse);
        };
        double share = first_share, good = best, bad = beyond(share);
        while (bad != worse && as_good(bad, best)) {
            good = bad;
            share *= 2;
            bad = beyond(share);
        }
        const auto near_enough = [&](double a, double b) {
            return std::abs(a - b) <= std::max(share_of_interval * std::abs(a - best), finest * best);
        };
        std::uintmax_t steps = most_steps;
        const auto [low, high] =
            boost::math::tools::toms748_solve([&](double value) { return excess(value, best); }, std::min(good, bad),
                                              std::max(good, bad), near_enough, steps);
        return worse < best ? low : high;
    }

    RuleScores& scores_;
    const Machine& machine_;
    std::string key_, of_;
};

/// Lower bounds of limits that the machine has.
std::vector<const IdentifiedParameter*> searched_limits(const Identification& result) {
    std::vector<const IdentifiedParameter*> limits;
    if (result.machine.kinematics.has_rotary()) return limits;
    for (const IdentifiedParameter& p : result.parameters) {
        const std::optional<double> now = planning_value(result.machine, p.name, p.axis);
        const bool unlimited = p.axis == "path" && now >= no_path_limit;
        const bool held_in_rapids_alone = p.name == "max_speed";
        if (p.reached == false && p.value > 0 && now > 0.0 && !unlimited && !held_in_rapids_alone) limits.push_back(&p);
    }
    return limits;
}

}  // namespace

void search_limits(double least_gain, RuleScores& scores, Identification& result) {
    for (int round = 0; round < most_rounds; ++round) {
        const Machine before = result.machine;
        for (const IdentifiedParameter* p : searched_limits(result)) {
            const LimitSlice slice(scores, result.machine, p->name, p->axis);
            const double now = *planning_value(result.machine, p->name, p->axis);
            set_planning_value(result.machine, p->name, p->axis, slice.best(std::min(p->value, now), now, least_gain));
        }
        if (plan_alike(before, result.machine)) return;
    }
}

std::vector<SimulatedLimit> limit_intervals(RuleScores& scores, const Identification& result) {
    std::vector<SimulatedLimit> limits;
    for (const IdentifiedParameter* p : searched_limits(result)) {
        const double now = *planning_value(result.machine, p->name, p->axis);
        limits.push_back(LimitSlice(scores, result.machine, p->name, p->axis).interval(std::min(p->value, now), now));
    }
    return limits;
}

void state_limits(const std::vector<SimulatedLimit>& limits, Identification& result) {
    // A slice takes the other limits as they are, and one that is a little wrong moves it.
    double fixed_errors = smallest_error;
    for (const IdentifiedParameter& p : result.parameters) {
        if (p.reached == true && p.standard_error) fixed_errors = std::max(fixed_errors, *p.standard_error / p.value);
    }
    for (const SimulatedLimit& limit : limits) {
        const auto p = std::find_if(result.parameters.begin(), result.parameters.end(),
                                    [&](const auto& each) { return each.name == limit.key && each.axis == limit.of; });
        if (limit.explains && limit.lowest && limit.highest) {
            // At √10 standard errors the criterion of independent samples rises by 10.
            const double farther = std::max(limit.best - *limit.lowest, *limit.highest - limit.best);
            const double error = std::max(correlation * farther / std::sqrt(decisive), fixed_errors * limit.best);
            p->value = rounded_to(limit.best, error);
            p->standard_error = error;
            p->reached = true;
            p->note = fmt::format("simulations with {:.6g} and {:.6g} explain the runs less well",
                                  rounded_to(*limit.lowest, error), rounded_to(*limit.highest, error));
            set_planning_value(result.machine, limit.key, limit.of, p->value);
        } else if (limit.lowest && *limit.lowest > p->value) {
            p->value = rounded_to(*limit.lowest, finest * *limit.lowest);
            p->shown = p->value;
            p->note = fmt::format("simulations with less explain the runs less well; the file has {:.6g}", limit.best);
        }
    }
}

}  // namespace clsurf

#include "identify/rule_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/tools/minima.hpp>

#include "core/error.h"
#include "core/parallel.h"
#include "simulation/path/block_merging.h"

namespace clsurf {
namespace {

constexpr PointIndex sample_records = 32;  ///< records of one sample; its residual is their mean |difference|

/// The mean |difference| of those that are not NaN; NaN: there are none.
float mean_size(std::span<const float> differences) {
    double sum = 0, count = 0;
    for (const float difference : differences) {
        if (!std::isnan(difference)) sum += std::abs(static_cast<double>(difference)), ++count;
    }
    return static_cast<float>(sum / count);
}

/// Computes the explanations from residuals and puts them into the candidates.
void score(const std::vector<std::vector<float>>& residuals, const RuleScores& scores,
           std::span<RuleCandidate> candidates) {
    const std::vector<Explanation> found = compare(residuals, scores);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        candidates[k].score = found[k].score;
        candidates[k].speed_error = found[k].speed_error;
    }
}

/// Share by which mean errors must differ to distinguish values, if the best one explains the runs. The criterion takes samples
/// as independent, but what a model leaves unexplained lasts for many of them. Of overrides on the same run, read from two files,
/// the right one had 1.5 and 6.9 % more error than the best, which the criterion called decisive. Where it did not distinguish two
/// overrides, the right one had 16 % less error.
constexpr double distinct_share = 0.1;

/// The candidates that explain the runs about as well as the best one.
std::vector<std::size_t> equal_to_best(std::span<const RuleCandidate> candidates, const RuleScores& scores) {
    double best = std::numeric_limits<double>::infinity(), least_error = best;
    for (const RuleCandidate& c : candidates) {
        best = std::min(best, c.score);
        least_error = std::min(least_error, c.speed_error);
    }
    const double most_error = scores.explains(least_error) ? (1 + distinct_share) * least_error : least_error;
    std::vector<std::size_t> equal;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const RuleCandidate& c = candidates[k];
        if (c.score <= best + decisive || c.speed_error <= most_error) equal.push_back(k);
    }
    return equal;
}

double rounded(double value) {
    // As in docs/design/identify.md#rules-of-the-planner.
    constexpr int digits = 3;
    const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(value)));
    return std::round(value * scale) / scale;
}

/// Searches for a better number between the neighbours of the chosen value and adds it to the candidates.
void refine(const Rule& rule, std::size_t chosen, RuleScores& scores, Machine& machine,
            std::vector<RuleCandidate>& candidates) {
    const std::vector<double>& numbers = rule.continuous.numbers;
    if (numbers.empty() || !(numbers[chosen] > 0)) return;
    const auto machine_with = [&](double number) {
        Machine changed = machine;
        rule.continuous.set(changed, number);
        return changed;
    };
    // Relative to the chosen value, because not all machines have the same samples.
    const std::vector<float> of_chosen = scores.residuals(machine);
    const auto score_of = [&](double number) {
        const std::vector<Explanation> both = compare({of_chosen, scores.residuals(machine_with(number))}, scores);
        return both[1].score - both[0].score;
    };
    const double below = chosen > 0 ? numbers[chosen - 1] : 0.5 * numbers[chosen],
                 above = chosen + 1 < numbers.size() ? numbers[chosen + 1] : 2 * numbers[chosen];
    // Ten bits are about three digits.
    constexpr int bits = 10;
    std::uintmax_t runs = 16;
    const double shown =
        rounded(boost::math::tools::brent_find_minima(score_of, below, above, bits, runs).first / rule.continuous.unit);
    const double best = shown * rule.continuous.unit;
    RuleCandidate refined{.rule = rule.name, .value = fmt::format("{}", shown), .axis = rule.axis};
    const std::vector<std::vector<float>> both{of_chosen, scores.residuals(machine_with(best))};
    std::vector<RuleCandidate> pair{candidates[chosen], refined};
    score(both, scores, pair);
    if (pair[1].score > pair[0].score - decisive) return;
    candidates[chosen].chosen = candidates[chosen].equal = false;
    pair[1].chosen = pair[1].equal = true;
    candidates.push_back(pair[1]);
    rule.continuous.set(machine, best);
}

/// Replaces unset values by the planner's defaults, if these are numbers.
ControllerSettings settled(ControllerSettings controller) {
    if (controller.planner != PlannerKind::trapezoidal && !controller.merging_tolerance)
        controller.merging_tolerance = 0;
    return controller;
}

bool limited_alike(const MachineAxis& one, const MachineAxis& other) {
    return one.max_speed == other.max_speed && one.max_acceleration == other.max_acceleration &&
           one.max_jerk == other.max_jerk;
}

}  // namespace

bool plan_alike(const Machine& one, const Machine& other) {
    return settled(one.controller) == settled(other.controller) && one.path == other.path &&
           one.kinematics.axis_tolerance == other.kinematics.axis_tolerance &&
           std::equal(one.axes.begin(), one.axes.end(), other.axes.begin(), limited_alike) &&
           std::equal(one.rotary.begin(), one.rotary.end(), other.rotary.begin(), limited_alike);
}

RuleScores::RuleScores(std::span<const RecordedRun> runs) {
    const bool five_axes = std::any_of(runs.begin(), runs.end(),
                                       [](const RecordedRun& run) { return run.part().path.kinematics != nullptr; });
    const PointIndex most = five_axes ? 50'000 : 200'000;  // simulations of five axes take longer
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

std::vector<float> RuleScores::residuals(const Machine& machine) {
    const Machine asked = merging_alike(machine);
    simulate_unknown({&asked, 1});
    return scored_[index_of_scored(asked)].residuals;
}

void RuleScores::prepare(std::span<const Machine> machines) {
    std::vector<Machine> asked;
    for (const Machine& machine : machines) asked.push_back(merging_alike(machine));
    simulate_unknown(asked);
}

std::size_t RuleScores::index_of_scored(const Machine& machine) const {
    const auto found = std::find_if(scored_.begin(), scored_.end(),
                                    [&](const Scored& scored) { return plan_alike(scored.machine, machine); });
    return static_cast<std::size_t>(found - scored_.begin());
}

void RuleScores::simulate_unknown(std::span<const Machine> machines) {
    const std::size_t first = scored_.size();
    for (const Machine& machine : machines) {
        if (index_of_scored(machine) == scored_.size()) scored_.push_back({machine, {}});
    }
    const std::size_t runs = runs_.size();
    std::vector<Residuals> found((scored_.size() - first) * runs);
    parallel_for(std::ssize(found), 1, [&](std::int64_t from, std::int64_t to) {
        for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k)
            found[k] = simulated(*runs_[k % runs], scored_[first + k / runs].machine);
    });
    for (std::size_t k = 0; k < found.size(); ++k) {
        std::vector<float>& all = scored_[first + k / runs].residuals;
        all.insert(all.end(), found[k].of_speed.begin(), found[k].of_speed.end());
        usual_speed_ = std::max(usual_speed_, found[k].usual_speed);
    }
}

/// The machine with the first requested tolerance that merges the same lines.
Machine RuleScores::merging_alike(const Machine& machine) {
    const ControllerSettings& c = machine.controller;
    const bool merges = c.planner == PlannerKind::trapezoidal || rounds_corners(c);
    if (machine.kinematics.has_rotary() || !merges) return machine;
    Merging here{c.planner, c.merging_tolerance, {}};
    for (const RecordedRun* run : runs_) {
        const std::vector<LineNumber> lines = merged_lines(run->part().program, machine);
        here.lines.insert(here.lines.end(), lines.begin(), lines.end());
    }
    Machine alike = machine;
    const auto same = std::find_if(mergings_.begin(), mergings_.end(), [&](const Merging& other) {
        return other.planner == here.planner && other.lines == here.lines;
    });
    if (same == mergings_.end())
        mergings_.push_back(std::move(here));
    else
        alike.controller.merging_tolerance = same->tolerance;
    return alike;
}

RuleScores::Residuals RuleScores::simulated(const RecordedRun& run, const Machine& machine) {
    Residuals result;
    std::optional<Part> simulation;
    try {
        simulation = run.simulated(machine);
    } catch (const InputError&) {
        // A machine that cannot run the program did not record the run: all samples differ.
        const std::size_t samples = (run.surface().positions.size() + sample_records - 1) / sample_records;
        result.of_speed.assign(samples, std::numeric_limits<float>::quiet_NaN());
        return result;
    }
    const RunDifferences found = run.differences(*simulation);
    result.usual_speed = found.usual_speed;
    const Column<float>& speed = found.of[index_of(RunQuantity::speed)];
    for (std::size_t i = 0; i < speed.size(); i += sample_records) {
        const std::size_t end = std::min<std::size_t>(i + sample_records, speed.size());
        result.of_speed.push_back(mean_size(std::span(speed).subspan(i, end - i)));
    }
    return result;
}

std::vector<Explanation> compare(const std::vector<std::vector<float>>& residuals, const RuleScores& scores) {
    std::vector<double> sums(residuals.size(), 0);
    std::size_t samples = 0;
    for (std::size_t i = 0; i < residuals.front().size(); ++i) {
        if (std::all_of(residuals.begin(), residuals.end(), [&](const auto& r) { return std::isnan(r[i]); })) continue;
        ++samples;
        for (std::size_t k = 0; k < residuals.size(); ++k)
            sums[k] += std::isnan(residuals[k][i]) ? scores.usual_speed() : static_cast<double>(residuals[k][i]);
    }
    std::vector<Explanation> found(residuals.size());
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        const auto n = static_cast<double>(samples);
        found[k].speed_error = samples > 0 ? sums[k] / n : scores.usual_speed();
        found[k].score = 2 * n * std::log(std::max(found[k].speed_error, scores.resolution()));
    }
    return found;
}

double RuleScores::mean_error(const Machine& machine) {
    return compare({residuals(machine)}, *this).front().speed_error;
}

bool RuleScores::has_compared() const {
    return std::any_of(scored_.begin(), scored_.end(), [](const Scored& scored) {
        return std::any_of(scored.residuals.begin(), scored.residuals.end(), [](float r) { return !std::isnan(r); });
    });
}

bool RuleScores::has_arcs() const {
    return std::any_of(runs_.begin(), runs_.end(), [](const RecordedRun* run) {
        const Motions& motions = run->part().program.motions;
        return std::any_of(motions.kind.begin(), motions.kind.end(), is_arc);
    });
}

bool RuleScores::explains(double mean_error) const {
    // As in docs/design/identify.md#rules-of-the-planner.
    constexpr double share = 0.002;  // of the speed
    return mean_error <= share * usual_speed();
}

double RuleScores::resolution() const {
    constexpr double of_positions = 0.005;  // mm/s: the resolution of differences of rounded positions …
    // As in docs/design/identify.md#rules-of-the-planner.
    constexpr double of_the_model = 0.0005;  // … and of any model, as a share of the speed
    return std::max(of_positions, of_the_model * usual_speed());
}

void search_rule(const Rule& rule, std::size_t present, double least_gain, RuleScores& scores, Identification& result) {
    std::vector<RuleCandidate> candidates;
    std::vector<Machine> machines;
    for (const RuleValue& value : rule.values) {
        machines.push_back(result.machine);
        value.apply(machines.back());
    }
    scores.prepare(machines);
    std::vector<std::vector<float>> residuals;
    for (const Machine& machine : machines) residuals.push_back(scores.residuals(machine));
    for (const RuleValue& value : rule.values) {
        candidates.push_back({.rule = rule.name, .value = value.name, .axis = rule.axis});
    }
    score(residuals, scores, candidates);
    const std::vector<std::size_t> equal = equal_to_best(candidates, scores);
    const bool keeps = std::find(equal.begin(), equal.end(), present) != equal.end();
    std::size_t chosen = *std::min_element(equal.begin(), equal.end(), [&](std::size_t a, std::size_t b) {
        return candidates[a].speed_error < candidates[b].speed_error;
    });
    const double needed = keeps ? std::max(least_gain, distinct_share) : least_gain;
    if (present < candidates.size() && candidates[chosen].speed_error >= (1 - needed) * candidates[present].speed_error)
        chosen = present;
    candidates[chosen].chosen = true;
    for (const std::size_t k : equal) candidates[k].equal = true;
    rule.values[chosen].apply(result.machine);
    if (equal.size() > 1) {
        std::vector<std::string> names;
        for (const std::size_t k : equal) names.push_back(rule.values[k].name);
        result.unidentified.push_back(
            {rule.name, rule.axis,
             fmt::format("the runs do not distinguish {}; kept {}", fmt::join(names, "; "), rule.values[chosen].name)});
    }
    if (equal.size() == 1 && equal.front() == chosen) refine(rule, chosen, scores, result.machine, candidates);
    std::move(candidates.begin(), candidates.end(), std::back_inserter(result.rules));
}

}  // namespace clsurf

#include "repair/feed_search.h"

#include <algorithm>
#include <array>
#include <set>

#include "repair/feeds/feed_equalisation.h"
#include "repair/regions.h"

namespace clsurf {
namespace {

// Relative steps from pass to pass, tried one after the other: docs/experiments/repair.md#the-search-in-detail, step 8.
constexpr std::array<double, 3> steps_between_passes{0.1, 0.05, 0.02};
constexpr double feed_tolerance = 0.003;  ///< as a share: a motion that is too fast by less gets no feed
constexpr int equalising_rounds = 3;      ///< within the available time
constexpr double most_share = 0.65;       ///< share of the available time for a round: feeds apply to whole lines
/// Share of the machine's acceleration. A feed applies to a whole line, so along a steep ramp, adjacent passes whose lines end
/// elsewhere differ. With ramps of 0.1, and with defects counted as `check` counts them, one part kept 35 instead of 64 defects
/// of motion (docs/experiments/kernel.md#what-made-the-difference).
constexpr std::array<double, 2> gentle_ramps{0.3, 0.1};
// Each takes a simulated run: docs/experiments/repair.md#the-search-in-detail, step 6.
constexpr int most_mixed_attempts = 3;  ///< number of combinations of the attempts of a round, place by place
constexpr double delay_factor = 1.5;    ///< times the last delay: the next attempt must be faster by this
constexpr double time_used = 0.95;      ///< sufficient share of the available time

Ramp gentle(Ramp ramp, double share) {
    ramp.acceleration *= share;
    return ramp;
}

/// The targets of a proposal, lowered to a speed per point of its run [mm/s]; unchanged if none is lower.
std::vector<float> lowered_targets(const Proposal& proposal, const std::vector<float>& speeds) {
    const std::vector<float> own =
        peaks_by_motion(proposal.run, proposal.draft->program, compared_speeds(proposal.run));
    const std::vector<float> wanted = peaks_by_motion(proposal.run, proposal.draft->program, speeds);
    std::vector<float> targets = proposal.targets;
    targets.resize(wanted.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const bool too_fast = wanted[i] < (1 - feed_tolerance) * own[i];
        if (!too_fast || (targets[i] > 0 && targets[i] <= wanted[i])) continue;
        targets[i] = wanted[i];
        any = true;
    }
    return any ? targets : proposal.targets;
}

/// The targets of a proposal, raised where its run was slower than the speeds for which they were set on the run of `from`.
std::vector<float> eased_targets(const Proposal& from, const Proposal& made, const std::vector<float>& speeds) {
    const std::vector<float> wanted = peaks_by_motion(from.run, from.draft->program, speeds);
    const std::vector<float> reached = peaks_by_motion(made.run, from.draft->program, compared_speeds(made.run));
    std::vector<float> targets = made.targets;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const float old = from.targets.empty() ? 0 : from.targets[i];
        if (targets[i] == old || !(reached[i] < wanted[i])) continue;
        targets[i] += wanted[i] - reached[i];
        if (old > 0) targets[i] = std::min(targets[i], old);
    }
    return targets;
}

/// For each motion, the target of the attempt (or of `from`) that ran best around it.
std::vector<float> best_targets(const Proposal& from, const std::vector<TriedProposal>& attempts, double longest) {
    std::vector<const JudgedRun*> runs{&from.run};
    for (const TriedProposal& each : attempts) runs.push_back(&each->run);
    RegionRules rules;
    rules.more_time = (longest - from.run.duration) / from.run.log.period;
    const std::vector<std::uint8_t> best = best_runs(runs, 0, from.draft->program, rules);
    if (std::ranges::count(best, 0) == std::ssize(best)) return from.targets;
    std::vector<float> targets(best.size(), 0);
    for (std::size_t i = 0; i < best.size(); ++i) {
        const std::vector<float>& of = best[i] == 0 ? from.targets : attempts[best[i] - 1U]->targets;
        targets[i] = of.empty() ? 0 : of[i];
    }
    return targets;
}

/// Whether a feed reduction removed defects near some of its causes but not near others. Adds the others to `abandoned`.
bool abandon_causes(const Proposal& from, const ReducedSpeeds& speeds, const Proposal& reduced,
                    std::vector<Vec3>& abandoned) {
    const std::vector<int> gains = gains_of(speeds, from.run, reduced.run);
    std::set<std::size_t> tried;
    for (const std::int32_t cause : speeds.causes) {
        if (cause >= 0) tried.insert(static_cast<std::size_t>(cause));
    }
    std::size_t lost = 0;
    for (const std::size_t k : tried) {
        if (gains[k] > 0) continue;
        abandoned.push_back(from.run.report.defects[k].place.tip);
        ++lost;
    }
    return lost > 0 && lost < tried.size();
}

}  // namespace

FeedSearch::FeedSearch(Evaluator& evaluator, const Machine& machine)
    : evaluator_(evaluator), lag_power_(lag_power(machine)), ramp_(ramp_of(machine)) {}

void FeedSearch::equalise(const TriedProposal& from) {
    const FeedEqualiser equaliser(from->run);
    for (const double step : steps_between_passes) {
        if (!evaluator_.has_time()) return;
        const TriedProposal equalised =
            evaluator_.propose(from->draft, lowered_targets(*from, equaliser.everywhere({step, 0, ramp_})));
        if (equalised->run.duration > evaluator_.longest()) return;  // lower feeds would take even longer
    }
}

void FeedSearch::equalise_in_time(const TriedProposal& from) {
    const double there = evaluator_.longest() - from->run.duration;
    const FeedEqualiser equaliser(from->run);
    const Ramp ramp = gentle(ramp_, gentle_ramps.back());
    double budget = most_share * there;
    for (int round = 0; round < equalising_rounds && budget > 0 && evaluator_.has_time(); ++round) {
        const std::vector<float> targets =
            lowered_targets(*from, equaliser.everywhere({0, equaliser.affordable_step(ramp, budget), ramp}));
        if (targets == from->targets) return;
        const TriedProposal equalised = evaluator_.propose(from->draft, targets);
        const double taken = equalised->run.duration - from->run.duration;
        if (taken <= there && taken > time_used * there) return;
        if (taken <= 0) return;
        budget *= std::clamp(0.5 * (1 + time_used) * there / taken, 0.2, 2.0);
    }
}

void FeedSearch::mix(const TriedProposal& from, std::vector<TriedProposal>& attempts) {
    double aim = evaluator_.longest();
    for (int k = 0; k < most_mixed_attempts && evaluator_.has_time(); ++k) {
        std::vector<float> mixed = best_targets(*from, attempts, aim);
        const auto is_mixed = [&](const TriedProposal& tried) { return tried->targets == mixed; };
        if (mixed == from->targets || std::ranges::any_of(attempts, is_mixed)) return;
        attempts.push_back(evaluator_.propose(from->draft, std::move(mixed)));
        aim -= delay_factor * std::max(0.0, attempts.back()->run.duration - evaluator_.longest());
    }
}

void FeedSearch::reduce_feeds(FeedReduction& reduction, int rounds) {
    FeedReductionRules rules;
    rules.lag_power = lag_power_;
    TriedProposal last_from;
    std::vector<float> last_targets;
    for (int round = 0; round < rounds && evaluator_.has_time(); ++round) {
        const TriedProposal from = reduction.from;
        rules.budget = reduction.share * (evaluator_.longest() - from->run.duration);
        if (rules.budget <= 0) return;
        rules.abandoned = reduction.abandoned;
        rules.ramp = ramp_;
        rules.step = reduction.step * from->run.report.thresholds.of[index_of(Quantity::speed)];
        ReducedSpeeds speeds = reduced_speeds(from->run, rules);
        std::vector<float> targets = lowered_targets(*from, speeds.speeds);
        if (targets == from->targets) {
            if (reduction.share == most_share) return;
            reduction.share = std::min(2 * reduction.share, most_share);
            continue;
        }
        if (from == last_from && targets == last_targets) {
            reduction.share /= 2;  // already tried: there may be another one for less time
            continue;
        }
        last_from = from;
        last_targets = targets;
        std::vector<TriedProposal> attempts{evaluator_.propose(from->draft, targets)};
        if (abandon_causes(*from, speeds, *attempts.back(), rules.abandoned) && evaluator_.has_time()) {
            speeds = reduced_speeds(from->run, rules);
            targets = lowered_targets(*from, speeds.speeds);
            if (targets != from->targets) attempts.push_back(evaluator_.propose(from->draft, targets));
        }
        if (evaluator_.has_time())
            attempts.push_back(evaluator_.propose(from->draft, eased_targets(*from, *attempts.back(), speeds.speeds)));
        for (const double share : gentle_ramps) {
            rules.ramp = gentle(ramp_, share);
            targets = lowered_targets(*from, reduced_speeds(from->run, rules).speeds);
            if (targets != from->targets && evaluator_.has_time())
                attempts.push_back(evaluator_.propose(from->draft, std::move(targets)));
        }
        mix(from, attempts);
        for (const TriedProposal& tried : attempts) {
            if (tried->run.duration <= evaluator_.longest() &&
                evaluator_.score(*tried) < evaluator_.score(*reduction.from))
                reduction.from = tried;
        }
        reduction.abandoned = rules.abandoned;
        reduction.share = reduction.from == from ? reduction.share / 2 : std::min(2 * reduction.share, most_share);
    }
}

}  // namespace clsurf

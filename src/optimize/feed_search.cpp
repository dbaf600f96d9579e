#include "optimize/feed_search.h"

#include <algorithm>
#include <array>
#include <set>

#include "optimize/levelling.h"

namespace clsurf {
namespace {

constexpr std::array<double, 3> steps_between_passes{0.1, 0.05, 0.02};
constexpr double play_of_feeds = 0.003;  ///< a motion this little too fast (a share) gets no feed
constexpr double cure_step = 0.7;        ///< of the threshold of a speed step, that is left about defects
constexpr int levelling_rounds = 3;      ///< with the time that there is
constexpr double most_share =
    0.65;  ///< of the time there is, that a round may reckon with: ramps to and from slower places take more
constexpr double time_used = 0.95;  ///< of what is there: enough

/// The targets of a proposal, and lower ones from a speed per point of its run [mm/s]; its own where none is lower.
std::vector<float> lowered_targets(const Proposal& proposal, const std::vector<float>& speeds) {
    const std::vector<float> own =
        means_by_motion(proposal.run, proposal.draft->program, compared_speeds(proposal.run));
    const std::vector<float> wanted = means_by_motion(proposal.run, proposal.draft->program, speeds);
    std::vector<float> targets = proposal.targets;
    targets.resize(wanted.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const bool too_fast = wanted[i] < (1 - play_of_feeds) * own[i];
        if (!too_fast || (targets[i] > 0 && targets[i] <= wanted[i])) continue;
        targets[i] = wanted[i];
        any = true;
    }
    return any ? targets : proposal.targets;
}

}  // namespace

FeedSearch::FeedSearch(Prover& prover, const Machine& machine) : prover_(prover), lag_power_(lag_power(machine)) {}

void FeedSearch::level(const Tried& from) {
    for (const double step : steps_between_passes) {
        if (!prover_.has_time()) return;
        const Tried levelled =
            prover_.propose(from->draft, lowered_targets(*from, levelled_speeds(from->run, {step, 0})));
        if (levelled->run.duration > prover_.longest()) return;  // lower feeds take longer still
    }
}

void FeedSearch::level_in_time(const Tried& from) {
    const double there = prover_.longest() - from->run.duration;
    double budget = most_share * there;
    for (int round = 0; round < levelling_rounds && budget > 0 && prover_.has_time(); ++round) {
        const std::vector<float> targets =
            lowered_targets(*from, levelled_speeds(from->run, {0, affordable_step(from->run, budget)}));
        if (targets == from->targets) return;
        const Tried levelled = prover_.propose(from->draft, targets);
        const double taken = levelled->run.duration - from->run.duration;
        if (taken <= there && taken > time_used * there) return;
        if (taken <= 0) return;
        budget *= std::clamp(0.5 * (1 + time_used) * there / taken, 0.2, 2.0);
    }
}

void FeedSearch::cure(Curing& curing, int rounds) {
    const JudgedRun& before = prover_.before();
    CureRules rules;
    rules.step = cure_step * before.report.thresholds.of[index_of(Quantity::speed)];
    rules.lag_power = lag_power_;
    for (int round = 0; round < rounds && prover_.has_time(); ++round) {
        const Tried from = curing.from;
        rules.budget = curing.share * (prover_.longest() - from->run.duration);
        if (rules.budget <= 0) return;
        rules.hopeless = curing.hopeless;
        const CuringSpeeds cure = curing_speeds(from->run, rules);
        const std::vector<float> targets = lowered_targets(*from, cure.speeds);
        if (targets == from->targets) {
            if (curing.share == most_share) return;
            curing.share = std::min(2 * curing.share, most_share);
            continue;
        }
        const Tried cured = prover_.propose(from->draft, targets);
        const Tried kept = prover_.has_time() ? without_losses(*from, cure, *cured, curing.hopeless) : nullptr;
        for (const Tried& tried : {cured, kept}) {
            if (tried && tried->run.duration <= prover_.longest() &&
                prover_.score(*tried) < prover_.score(*curing.from))
                curing.from = tried;
        }
        curing.share = curing.from == from ? curing.share / 2 : std::min(2 * curing.share, most_share);
    }
}

/// The feeds of `from` where its cure left no fewer defects, those of the cure elsewhere; such defects become hopeless.
/// nullptr: all have fewer, or none.
Tried FeedSearch::without_losses(const Proposal& from, const CuringSpeeds& cure, const Proposal& cured,
                                 std::vector<Vec3>& hopeless) {
    const std::vector<int> gains = gains_of(cure, from.run, cured.run);
    const std::vector<std::int32_t> causes = causes_by_motion(cure, from.run, from.draft->program);
    std::vector<float> targets = cured.targets;
    bool any = false;  // is left
    std::set<std::size_t> lost;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const float old = from.targets.empty() ? 0 : from.targets[i];
        if (targets[i] == old) continue;
        if (causes[i] < 0 || gains[static_cast<std::size_t>(causes[i])] > 0) {
            any = true;
            continue;
        }
        targets[i] = old;
        lost.insert(static_cast<std::size_t>(causes[i]));
    }
    for (const std::size_t k : lost) hopeless.push_back(from.run.report.defects[k].position);
    return lost.empty() || !any ? nullptr : prover_.propose(from.draft, std::move(targets));
}

}  // namespace clsurf

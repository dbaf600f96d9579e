#include "optimize/optimizer.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/error.h"
#include "core/statistics.h"
#include "optimize/cure.h"
#include "optimize/levelling.h"
#include "optimize/line_edit.h"
#include "optimize/need.h"
#include "optimize/resample.h"

namespace clsurf {
namespace {

constexpr std::array<double, 3> shares_of_tolerance{0.2, 0.1, 0.4};  ///< that lines may leave the curve by
constexpr double block_reserve = 1.1;    ///< of the way in a block time
constexpr std::array<double, 3> steps_between_passes{0.1, 0.05, 0.02};
constexpr double play_of_feeds = 0.003;  ///< a motion this little too fast (a share) gets no feed
constexpr double cure_step = 0.7;        ///< of the threshold of a speed step, that is left about defects
constexpr int rounds = 8;                ///< of a cure
constexpr double most_share = 0.65;      ///< of the time there is, that a round may reckon with: ramps to and from slower places take more
constexpr std::array<double, 2> first_shares{0.3, 0.65};  ///< of a cure that begins with the cheap defects, and of one that takes all it can
constexpr double most_points = 4e6;      ///< of all runs together; then what there is has to do

/// The median feed of the cutting lines [mm/s].
double usual_feed(const Program& program) {
    std::vector<double> feeds;
    for (std::int64_t i = 0; i < program.motions.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (program.motions.kind[k] == MotionKind::feed && program.motions.feed[k] > 0) feeds.push_back(program.motions.feed[k]);
    }
    return feeds.empty() ? 0 : median(feeds);
}

/// The targets of a proposal, and lower ones from a speed per point of its run [mm/s]; its own where none is lower.
std::vector<float> lowered_targets(const Proposal& proposal, const std::vector<float>& speeds) {
    const std::vector<float> own = means_by_motion(proposal.run, proposal.draft->program, compared_speeds(proposal.run));
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

class Optimizer {
public:
    Optimizer(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics)
        : program_(program), read_(read), machine_(machine), rules_(rules), diagnostics_(diagnostics), prover_(program, read, machine, rules, progress, diagnostics) {
        if (prover_.before().surface.step_over <= 0) throw InputError(Place::of_file(program_.main().name()), "has no passes beside each other: there is nothing to bring into step");
    }

    Optimized run(std::optional<Log> measured) {
        Optimized result;
        if (measured) result.measured = judge_measured(std::move(*measured));
        else needed_ = motions_in_need(prover_.before(), program_, {});
        propose_all();
        result.before = prover_.take_before();
        result.run_before = prover_.summary_before();
        result.proof = std::move(best_->proof);
        result.text = std::move(best_->text);
        result.after = std::move(best_->run);
        result.run_after = std::move(best_->summary);
        return result;
    }

private:
    using Tried = std::shared_ptr<Proposal>;

    Measured judge_measured(Log log) {
        const JudgedRun run = judge_run(std::move(log), program_, rules_.quality, diagnostics_);
        if (run.surface.step_over <= 0) throw InputError(Place::of_file(run.log.name), "has no passes beside each other: it does not tell what is out of step");
        needed_ = motions_in_need(run, program_, {});
        measured_ = true;
        return {run.surface.positions.size(), run.duration, run.mismatch, run.report.defects.size(), static_cast<std::size_t>(std::count(needed_.begin(), needed_.end(), 1))};
    }

    [[nodiscard]] bool has_time() const { return prover_.points() < most_points; }

    void propose_all() {
        const ProgrammedSurface laid = lay_out(program_);
        const double shortest_line = block_reserve * machine_.controller.block_time * usual_feed(program_);
        std::vector<Tried> plain;  // the points alone
        for (const double share : shares_of_tolerance) {
            // What is tried last is left out first where a program is long.
            if (!has_time()) break;
            const auto draft = std::make_shared<const Draft>(resampled(laid, share * rules_.tolerance, shortest_line));
            if (draft->stretches > 0) plain.push_back(propose(draft, {}));
        }
        if (plain.empty()) propose(std::make_shared<const Draft>(Draft{program_, std::string(program_.main().text()), 0, 0, {}}), {});
        std::stable_sort(plain.begin(), plain.end(), [&](const Tried& a, const Tried& b) { return prover_.score(*a) < prover_.score(*b); });
        for (const Tried& points : plain) {
            for (const double share : first_shares) cure(points, share);
            level(points);
        }
    }

    /// Feeds that bring neighbour passes within a step of each other everywhere.
    void level(const Tried& plain) {
        for (const double step : steps_between_passes) {
            if (!has_time()) return;
            const Tried levelled = propose(plain->draft, lowered_targets(*plain, levelled_speeds(plain->run, step)));
            if (levelled->run.duration > prover_.before().duration) return;  // lower feeds take longer still
        }
    }

    /// Round by round slower where defects are left, as long as there is time to lose, a share of it in the first round.
    void cure(Tried from, double share) {
        const JudgedRun& before = prover_.before();
        CureRules rules;
        rules.step = cure_step * before.report.thresholds.of[index_of(Quantity::speed)];
        rules.lag_power = lag_power(machine_);
        for (int round = 0; round < rounds && has_time(); ++round) {
            rules.budget = share * (before.duration - from->run.duration);
            if (rules.budget <= 0) return;
            const CuringSpeeds cure = curing_speeds(from->run, rules);
            const std::vector<float> targets = lowered_targets(*from, cure.speeds);
            if (targets == from->targets) {
                if (share == most_share) return;
                share = std::min(2 * share, most_share);
                continue;
            }
            const Tried cured = propose(from->draft, targets);
            const Tried kept = has_time() ? without_losses(*from, cure, *cured, rules.hopeless) : nullptr;
            Tried next = from;
            for (const Tried& tried : {cured, kept}) {
                if (tried && tried->run.duration <= before.duration && prover_.score(*tried) < prover_.score(*next)) next = tried;
            }
            share = next == from ? share / 2 : std::min(2 * share, most_share);
            from = next;
        }
    }

    /// The feeds of `from` where its cure left no fewer defects, those of the cure elsewhere; such defects become hopeless.
    /// nullptr: all have fewer, or none.
    Tried without_losses(const Proposal& from, const CuringSpeeds& cure, const Proposal& cured, std::vector<Vec3>& hopeless) {
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
        return lost.empty() || !any ? nullptr : propose(from.draft, std::move(targets));
    }

    Tried propose(const std::shared_ptr<const Draft>& draft, std::vector<float> targets) {
        const auto tried = std::make_shared<Proposal>(prover_.prove(draft, std::move(targets)));
        if (!best_ || prover_.better(*tried, *best_)) best_ = tried;
        return tried;
    }

    [[nodiscard]] Draft resampled(const ProgrammedSurface& laid, double chord_error, double shortest_line) const {
        Draft draft;
        const double spacing = 0.5 * fitting_spacing(program_, laid, chord_error);
        LineEditor editor(program_, rules_.least_decimals);
        const std::vector<Stretch> stretches = resample(program_, laid, editor, {rules_.tolerance, spacing, chord_error, shortest_line, ResampleRules{}.corner_angle}, needed_);
        std::int64_t old = 0;  // motions so far
        for (const Stretch& stretch : stretches) {
            const std::size_t lines = editor.replace(stretch.first, stretch.last, stretch.points);
            if (!measured_) continue;
            draft.may_slow.insert(draft.may_slow.end(), needed_.begin() + old, needed_.begin() + stretch.first);
            draft.may_slow.insert(draft.may_slow.end(), lines, 1);
            old = stretch.last + 1;
        }
        if (measured_) draft.may_slow.insert(draft.may_slow.end(), needed_.begin() + old, needed_.end());
        draft.text = editor.text(rules_.header);
        draft.program = read_(draft.text);
        draft.stretches = stretches.size();
        draft.changed_lines = editor.changed_lines();
        return draft;
    }

    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    Diagnostics& diagnostics_;
    Prover prover_;
    Tried best_;
    std::vector<std::uint8_t> needed_;  ///< one entry a motion
    bool measured_ = false;             ///< that tells a recorded run
};

}  // namespace

Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, std::optional<Log> measured, const Progress& progress, Diagnostics& diagnostics) {
    return Optimizer(program, read, machine, rules, progress, diagnostics).run(std::move(measured));
}

}  // namespace clsurf

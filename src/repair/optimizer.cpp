#include "repair/optimizer.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/statistics.h"
#include "intervals/interval_feeds.h"
#include "machine/machine_ensemble.h"
#include "repair/feed_search.h"
#include "repair/feeds/ramp.h"
#include "repair/regions.h"
#include "repair/repair_mask.h"
#include "toolpath/tip_motions.h"

namespace clsurf {
namespace {

// shares_of_tolerance, mixing_rounds, most_mixing_rounds, most_fed, most_equalised_early, more_rounds:
// docs/experiments/repair.md#the-search-in-detail. worst_rules, slow_rules: docs/optimize.md#method, step 2. periods_a_line:
// planners that put arcs into corners slow down at shorter lines (docs/experiments/kernel.md#what-made-the-difference).
constexpr std::array<double, 3> shares_of_tolerance{0.2, 0.1, 0.4};  ///< distance of lines from the curve
constexpr double reserve = 1.1;                     ///< factor for the arc length in a block time or in periods
constexpr double periods_a_line = 2;                ///< periods per line with the trapezoidal planner
constexpr RepairMaskRules worst_rules{0.5, 2, 2};   ///< a draft that changes less
constexpr RepairMaskRules slow_rules{.slow = 0.9};  ///< a draft that saves time
constexpr std::size_t most_mixed = 2;               ///< drafts whose regions are reset …
constexpr int mixing_rounds = 3;                    ///< … so many times …
constexpr int most_mixing_rounds = 6;               ///< … or more, while the run is refused
constexpr std::size_t most_sections_alone = 24;     ///< sections that are tried alone if nothing else is accepted
constexpr double share_of_drafts = 0.35;            ///< share of all runs for points alone; the others are for feeds
constexpr double most_time_to_regain = 0.01;        ///< as a share, by motions that get their old points back
constexpr std::size_t most_fed = 5;                 ///< drafts for which feeds are searched …
constexpr std::size_t most_fed_ends = 2;            ///< … and those with lines that are alike at the ends of passes
constexpr std::size_t most_equalised_early = 2;     ///< drafts of these that are equalised early
constexpr double most_behind = 0.2;   ///< by score, after the first rounds: drafts farther behind the best are dropped
constexpr double small_share = 0.3;   ///< share of the time for a reduction that begins with inexpensive defects …
constexpr double large_share = 0.65;  ///< … and for one that uses as much as it can
constexpr int first_rounds = 2, more_rounds = 8;
constexpr std::size_t most_listed = 8;  ///< accepted finalists, if all are listed
// Remaining defects depend on the ramps of others, so another step is another attempt:
// docs/experiments/repair.md#the-search-in-detail, steps 7 and 9.
constexpr std::array<double, 2> other_steps{0.85, 0.55};  ///< other steps for feed reductions …
constexpr std::size_t most_drafts_of_other_steps = 2;     ///< … for at most this many drafts
/// Steps for the best proposal, one after the other …
constexpr std::array<double, 4> polishing_steps{FeedReduction::usual_step, 0.85, 0.55, 0.4};
constexpr double least_polished = 1e-3;  ///< … repeated while the score falls by this much

// docs/experiments/repair.md#the-ends-of-passes.
constexpr std::array<double, 3> end_steps{2, 1.4, 1};  ///< lengths of the lines near the ends of passes, in usual lines
constexpr double usual_first_line = 0.25;              ///< length of the first and last line, as a share of these …
constexpr std::array<double, 2> other_first_lines{0.1, 0.5};  ///< … and other ones for the best of the lengths
constexpr double least_end_lines = 4;                         ///< lines that are alike at the ends of passes
constexpr double least_runs_for_ends = 120;  ///< in a shorter search, other steps would miss these runs

/// The median feed of the cutting lines [mm/s].
double usual_feed(const Program& program) {
    std::vector<double> feeds;
    for (std::int64_t i = 0; i < program.motions.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (program.motions.kind[k] == MotionKind::feed && program.motions.feed[k] > 0)
            feeds.push_back(program.motions.feed[k]);
    }
    return feeds.empty() ? 0 : median(feeds);
}

class Optimizer {
public:
    Optimizer(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
              const Progress& progress, Diagnostics& diagnostics)
        : program_(program),
          read_(read),
          machine_(machine),
          rules_(rules),
          diagnostics_(diagnostics),
          evaluator_(program, read, machine, rules, progress, diagnostics) {
        if (evaluator_.before().surface.step_over <= 0)
            throw InputError(Place::of_file(program_.main().name()),
                             "has no adjacent passes: there is nothing to equalise");
    }

    Optimized run(std::optional<Log> measured) {
        Optimized result;
        const bool has_log = measured.has_value();
        if (has_log)
            result.measured = judge_measured(std::move(*measured));
        else
            find_masks(evaluator_.before());
        propose_all({program_, read_, machine_, rules_, !has_log, evaluator_.orientation()});
        result.fidelity = machine_.fidelity;
        result.five_axes = evaluator_.orientation() != nullptr;
        if (rules_.weight) evaluator_.prefer(*rules_.weight);
        Proposal& best = *choose(result);
        if (rules_.needs_front()) result.front = evaluator_.front(best.evaluation.accepted ? &best : nullptr);
        result.before = evaluator_.take_before();
        result.roughness_before = best.roughness ? best.roughness->before : evaluator_.roughness_before();
        if (best.roughness) result.roughness_after = std::move(best.roughness->after);
        result.evaluation = std::move(best.evaluation);
        result.text = std::move(best.text);
        result.after = std::move(best.run);
        return result;
    }

private:
    /// The best proposal that the ensemble accepts. If it accepts none, the best of all, refused with the ensemble's reason.
    TriedProposal choose(Optimized& result) {
        measure_roughness();
        const std::vector<TriedProposal> finalists = evaluator_.finalists();
        if (finalists.empty()) return evaluator_.best();
        Ensemble ensemble(program_, machines_drawn_from(machine_, rules_.machines), rules_, evaluator_.kinematics());
        TriedProposal chosen;
        std::string refusal;
        EnsembleResult refused;
        std::vector<Finalist> doubtful;
        for (const TriedProposal& each : finalists) {
            if (!each->evaluation.accepted) {
                if (refusal.empty()) refusal = each->evaluation.reason;
                continue;
            }
            const Program changed = read_(each->text);
            if (rules_.machines > 0) evaluator_.report_progress("the best candidates on other machines");
            const EnsembleResult runs = ensemble.run(changed);
            const std::string reason = why_not_better(runs, rules_.more_time);
            if (!reason.empty()) {
                if (refusal.empty()) refused = runs;
                if (refusal.empty()) refusal = reason;
                if (rules_.all_finalists)
                    doubtful.push_back({each->text, each->run.measures(), each->evaluation, runs});
                continue;
            }
            result.finalists.push_back({each->text, each->run.measures(), each->evaluation, runs});
            if (chosen == nullptr) result.ensemble = runs;
            if (chosen == nullptr) chosen = each;
            if (!rules_.all_finalists || result.finalists.size() == most_listed) break;
        }
        // If a controller decides, it may also run these.
        std::move(doubtful.begin(), doubtful.end(), std::back_inserter(result.finalists));
        if (chosen != nullptr) return chosen;
        result.ensemble = refused;
        finalists.front()->evaluation.accepted = false;
        finalists.front()->evaluation.reason = refusal;
        return finalists.front();
    }

    void measure_roughness() {
        if (!rules_.tool) return;
        if (evaluator_.orientation() == nullptr) return evaluator_.measure_roughness(*rules_.tool);
        diagnostics_.add({Severity::note,
                          "optimize.tilted-tool",
                          Place::of_file(program_.main().name()),
                          "roughness is not measured: the tool may be tilted",
                          {}});
    }

    void find_masks(const JudgedRun& run) {
        mask_ = repair_mask(run, program_, {});
        worst_mask_ = repair_mask(run, program_, worst_rules);
        slow_mask_ = repair_mask(run, program_, slow_rules);
    }

    Measured judge_measured(Log log) {
        const JudgedRun run = judge_run(std::move(log), program_, diagnostics_, evaluator_.kinematics(),
                                        rules_.identity, rules_.derivative);
        if (run.surface.step_over <= 0)
            throw InputError(Place::of_file(run.log.name),
                             "has no adjacent passes: it does not show which passes differ");
        find_masks(run);
        return {run.surface.positions.size(), run.duration, run.mismatch, run.report.defects.size(),
                static_cast<std::size_t>(std::count(mask_.begin(), mask_.end(), 1))};
    }

    /// Many lines that a controller runs in less than block_time, or in few periods, would slow it down. With the trapezoidal
    /// planner the effect of short lines depends on the corners, so both are tried.
    [[nodiscard]] std::vector<DraftLines> line_choices() const {
        const ControllerSettings& controller = machine_.controller;
        const double feed = usual_feed(program_);
        std::vector<double> shortest{reserve * controller.block_time * feed};
        if (controller.planner == PlannerKind::trapezoidal)
            shortest = {reserve * periods_a_line * controller.period * feed, 0};
        std::vector<DraftLines> choices;
        for (const double line : shortest) {
            for (const double share : shares_of_tolerance) choices.push_back({share * rules_.tolerance, line});
        }
        return choices;
    }

    /// Proposes the best draft, and the program itself, with lines that are alike at the ends of all passes. The best first.
    [[nodiscard]] std::vector<TriedProposal> propose_ends(const Drafter& drafter, const Draft& best) {
        std::vector<TriedProposal> drafts;
        if (evaluator_.most_runs() < least_runs_for_ends) return drafts;
        const auto propose_lines = [&](const EndLines& ends, const std::vector<std::uint8_t>& needed) {
            DraftLines lines = best.lines;
            lines.ends = ends;
            if (evaluator_.has_time(share_of_drafts)) propose(drafter.draft(lines, needed), drafts);
        };
        const std::vector<std::uint8_t> nothing(best.needed.size(), 0);
        const double usual = drafter.usual_spacing(), feed = usual_feed(program_);
        // Planners that overlap blocks stop the tool with half of its acceleration.
        const double to_stop = feed * feed / ramp_of(machine_).acceleration;
        for (const double share : end_steps) {
            const double step = share * usual;
            const EndLines ends{usual_first_line * step, step, std::max(to_stop, least_end_lines * step)};
            propose_lines(ends, best.needed);
            propose_lines(ends, nothing);
        }
        sort(drafts);
        if (drafts.empty()) return drafts;
        const std::shared_ptr<const Draft> first = drafts.front()->draft;
        for (const double share : other_first_lines) {
            EndLines ends = first->lines.ends;
            ends.first = share * ends.step;
            propose_lines(ends, first->needed);
        }
        mix(drafter, drafts.front(), drafts);
        sort(drafts);
        return drafts;
    }

    /// Proposes each draft, and the program itself, with the speeds of its constant-speed intervals.
    void propose_intervals(const Drafter& drafter) {
        std::vector<Draft> drafts;
        drafts.push_back(drafter.unchanged());
        for (const DraftLines& lines : line_choices()) drafts.push_back(drafter.draft(lines, slow_mask_));
        for (Draft& draft : drafts) {
            if (!evaluator_.has_time()) return;
            std::vector<float> feeds = interval_feeds(draft.program, machine_);
            (void)evaluator_.propose(std::make_shared<const Draft>(std::move(draft)), std::move(feeds));
        }
    }

    void propose_all(const Drafter& drafter) {
        if (rules_.more_time > 0 && rules_.feeds == FeedChoice::intervals) evaluator_.allow_more_time();
        if (rules_.feeds == FeedChoice::intervals) return propose_intervals(drafter);
        std::vector<TriedProposal> drafts;  // points alone
        const std::vector<DraftLines> choices = line_choices();
        for (const DraftLines& lines : choices) {
            // The last ones are skipped first if a program is long.
            if (evaluator_.has_time()) propose(drafter.draft(lines, mask_), drafts);
        }
        for (const DraftLines& lines : choices) {
            if (slow_mask_ != mask_ && evaluator_.has_time(share_of_drafts))
                propose(drafter.draft(lines, slow_mask_), drafts);
        }
        if (drafts.empty()) {
            (void)evaluator_.propose(std::make_shared<const Draft>(drafter.unchanged()), {});
            return;
        }
        sort(drafts);
        const std::vector<TriedProposal> ended = propose_ends(drafter, *drafts.front()->draft);
        std::vector<TriedProposal> mixed, narrow;
        for (std::size_t k = 0; k < std::min(most_mixed, drafts.size()); ++k) {
            mix(drafter, drafts[k], mixed);
            if (evaluator_.has_time(share_of_drafts))
                propose(drafter.draft(drafts[k]->draft->lines, worst_mask_), narrow);
        }
        if (!evaluator_.best()->evaluation.accepted) {
            std::vector<TriedProposal> all = drafts;
            all.insert(all.end(), mixed.begin(), mixed.end());
            all.insert(all.end(), narrow.begin(), narrow.end());
            sort(all);
            for (std::size_t k = 0; k < std::min(most_mixed, all.size()); ++k)
                combine_sections(drafter, *all[k], mixed);
        }
        sort(mixed);
        // Alternating: a draft that saves most time may be better with feeds than one that is better without.
        std::vector<TriedProposal> order;
        for (std::size_t k = 0; k < std::max({drafts.size(), mixed.size(), narrow.size()}); ++k) {
            for (const std::vector<TriedProposal>* each : {&drafts, &narrow, &mixed}) {
                if (k < each->size()) order.push_back((*each)[k]);
            }
        }
        order.resize(std::min(order.size(), most_fed));
        order.insert(order.end(), ended.begin(),
                     ended.begin() + static_cast<std::ptrdiff_t>(std::min(ended.size(), most_fed_ends)));
        seek_feeds(order);
    }

    /// Searches feeds for the drafts, a few rounds for each, then all rounds, the best first.
    void seek_feeds(const std::vector<TriedProposal>& drafts) {
        FeedSearch feeds(evaluator_, machine_);
        struct Fed {
            TriedProposal points;
            FeedReduction reduction;
        };
        std::vector<Fed> fed;
        for (const TriedProposal& points : drafts) {
            fed.push_back({points, {points, small_share}});
            feeds.reduce_feeds(fed.back().reduction, first_rounds);
        }
        std::stable_sort(fed.begin(), fed.end(), [&](const Fed& a, const Fed& b) {
            return evaluator_.score(*a.reduction.from) < evaluator_.score(*b.reduction.from);
        });
        const double best_so_far = evaluator_.score(*evaluator_.best());
        // Early, because the search for a long program ends before all is tried.
        for (std::size_t k = 0; k < std::min(fed.size(), most_equalised_early); ++k)
            feeds.equalise_in_time(fed[k].points);
        feeds.equalise_in_time(evaluator_.best());
        for (Fed& each : fed) {
            if (evaluator_.score(*each.reduction.from) < best_so_far + most_behind)
                feeds.reduce_feeds(each.reduction, more_rounds - first_rounds);
        }
        feeds.equalise_in_time(evaluator_.best());
        for (std::size_t k = most_equalised_early; k < fed.size(); ++k) feeds.equalise_in_time(fed[k].points);
        for (const double step : other_steps) {
            for (std::size_t k = 0; k < std::min(fed.size(), most_drafts_of_other_steps); ++k) {
                FeedReduction other{fed[k].points, small_share, step};
                feeds.reduce_feeds(other, more_rounds);
            }
            reduce_best(feeds, step);
        }
        for (const Fed& each : fed) {
            FeedReduction other{each.points, large_share};
            feeds.reduce_feeds(other, more_rounds);
            feeds.equalise(each.points);
        }
        polish(feeds);
        if (rules_.more_time <= 0) return;
        // After everything within the original time: additional time extends that search and never makes the result worse.
        evaluator_.allow_more_time();
        reduce_best(feeds);
        for (const Fed& each : fed) {
            feeds.equalise_in_time(each.points);
            FeedReduction other{each.points, large_share};
            feeds.reduce_feeds(other, more_rounds);
        }
    }

    /// Repeats feed reductions of the best proposal, one step after the other, as long as the score falls.
    void polish(FeedSearch& feeds) const {
        double before = 0;
        do {
            before = evaluator_.score(*evaluator_.best());
            for (const double step : polishing_steps) reduce_best(feeds, step);
        } while (evaluator_.score(*evaluator_.best()) < before - least_polished);
    }

    void reduce_best(FeedSearch& feeds, double step = FeedReduction::usual_step) const {
        FeedReduction best{evaluator_.best(), large_share, step};
        if (best.from->evaluation.accepted) feeds.reduce_feeds(best, more_rounds);
    }

    /// Proposes a draft without feeds; nullptr: it changes nothing.
    TriedProposal propose(Draft draft, std::vector<TriedProposal>& drafts) {
        if (draft.segments == 0) return nullptr;
        drafts.push_back(evaluator_.propose(std::make_shared<const Draft>(std::move(draft)), {}));
        return drafts.back();
    }

    /// In rounds, gives motions their old points back where a draft runs worse than the program.
    void mix(const Drafter& drafter, TriedProposal from, std::vector<TriedProposal>& drafts) {
        for (int round = 0; round < most_mixing_rounds && from && evaluator_.has_time(share_of_drafts); ++round) {
            if (round >= mixing_rounds && from->evaluation.accepted) return;
            const std::array<const JudgedRun*, 2> runs{&evaluator_.before(), &from->run};
            const std::vector<std::uint8_t> best = best_runs(runs, 1, program_, {});
            std::vector<std::uint8_t> needed = from->draft->needed;
            for (std::size_t i = 0; i < needed.size(); ++i) needed[i] = needed[i] != 0 && best[i] != 0 ? 1 : 0;
            if (needed == from->draft->needed) return;
            from = propose(drafter.draft(from->draft->lines, std::move(needed)), drafts);
        }
    }

    /// Tries each section of a draft alone. Then combines those that are better alone, the best first, as long as the score
    /// falls.
    void combine_sections(const Drafter& drafter, const Proposal& from, std::vector<TriedProposal>& drafts) {
        const std::vector<std::uint8_t>& needed = from.draft->needed;
        std::vector<std::pair<std::size_t, std::size_t>>
            sections;  // motions, from the first up to but excluding the second
        for (std::size_t i = 0; i < needed.size(); ++i) {
            if (needed[i] == 0) continue;
            if (i > 0 && needed[i - 1] != 0)
                sections.back().second = i + 1;
            else
                sections.emplace_back(i, i + 1);
        }
        if (sections.size() < 2 || sections.size() > most_sections_alone) return;
        const auto with = [&](std::vector<std::uint8_t> motions, const std::pair<std::size_t, std::size_t>& section) {
            std::fill(motions.begin() + static_cast<std::ptrdiff_t>(section.first),
                      motions.begin() + static_cast<std::ptrdiff_t>(section.second), std::uint8_t{1});
            return motions;
        };
        const RunMeasures before = evaluator_.before().measures();
        double best = objective(before, before, 1, rules_.more_time);
        std::vector<std::pair<double, std::size_t>> better;
        for (std::size_t k = 0; k < sections.size() && evaluator_.has_time(share_of_drafts); ++k) {
            const TriedProposal alone = propose(
                drafter.draft(from.draft->lines, with(std::vector<std::uint8_t>(needed.size(), 0), sections[k])),
                drafts);
            if (alone && !is_late(*alone) && evaluator_.score(*alone) < best)
                better.emplace_back(evaluator_.score(*alone), k);
        }
        std::sort(better.begin(), better.end());
        std::vector<std::uint8_t> taken(needed.size(), 0);
        for (const auto& [score, k] : better) {
            if (!evaluator_.has_time(share_of_drafts)) return;
            std::vector<std::uint8_t> more = with(taken, sections[k]);
            const TriedProposal together = propose(drafter.draft(from.draft->lines, more), drafts);
            if (!together || is_late(*together) || !(evaluator_.score(*together) < best)) continue;
            best = evaluator_.score(*together);
            taken = std::move(more);
        }
    }

    /// Whether a draft takes so long that neither old points nor lower feeds would help.
    [[nodiscard]] bool is_late(const Proposal& draft) const {
        return draft.run.duration > evaluator_.before().duration * (1 + rules_.more_time + most_time_to_regain);
    }

    /// Sorts by score, but puts the best accepted one first and the late ones last, because the score ignores delays.
    void sort(std::vector<TriedProposal>& drafts) const {
        std::stable_sort(drafts.begin(), drafts.end(), [&](const TriedProposal& a, const TriedProposal& b) {
            return is_late(*a) != is_late(*b) ? is_late(*b) : evaluator_.score(*a) < evaluator_.score(*b);
        });
        const auto accepted = std::find_if(drafts.begin(), drafts.end(),
                                           [](const TriedProposal& tried) { return tried->evaluation.accepted; });
        if (accepted != drafts.end()) std::rotate(drafts.begin(), accepted, accepted + 1);
    }

    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    Diagnostics& diagnostics_;
    Evaluator evaluator_;
    std::vector<std::uint8_t> mask_, worst_mask_, slow_mask_;  ///< one entry per motion
};

}  // namespace

Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
                   std::optional<Log> measured, const Progress& progress, Diagnostics& diagnostics) {
    if (!runs_on_five_axes(program, machine))
        return Optimizer(program, read, machine, rules, progress, diagnostics).run(std::move(measured));
    const auto of_the_tip = [&](Program programmed) {
        solve_tool_axes(programmed, machine);
        make_tip_motions(programmed, machine.kinematics, -rules.zero, rules.start);
        return programmed;
    };
    Program turned = program;
    turned.diagnostics = {};
    turned = of_the_tip(std::move(turned));
    diagnostics.append(turned.diagnostics);
    const ReadProgram read_turned = [&](const std::string& text) { return of_the_tip(read(text)); };
    return Optimizer(turned, read_turned, machine, rules, progress, diagnostics).run(std::move(measured));
}

}  // namespace clsurf

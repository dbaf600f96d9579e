#include "repair/proposal.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/units.h"
#include "repair/feeds/feed_equalisation.h"
#include "repair/line_edit.h"

namespace clsurf {
namespace {

constexpr double interval_width =
    0.005;  ///< of the speeds in a constant-speed interval: wider, passes side by side differ by as much
constexpr double most_run_points = 16e6;  ///< of all runs together; then what there is has to do …
constexpr double large_run = 1e6;         ///< … or less, down to a share of it where a run has so many points …
constexpr double share_of_large = 0.25;   ///< … this
constexpr int most_in_vain = 96;          ///< proposals in a row, none of them better than the best
constexpr double growth_weight = 0.03;    ///< of a program's growth, against shares of mismatch and defects
constexpr double goal_of_mismatch = 0.5;  ///< share left, from which on …
constexpr double beyond_goal = 0.1;       ///< … less mismatch counts less

}  // namespace

Evaluator::Evaluator(const Program& program, const ReadProgram& read, const Machine& machine,
                     const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics)
    : program_(program), read_(read), machine_(machine), rules_(rules), progress_(progress), diagnostics_(diagnostics) {
    if (runs_on_five_axes(program_, machine_)) {
        kinematics_ = std::make_shared<const Kinematics>(machine_.kinematics);
        orientation_ = std::make_unique<const Orientation>(program_, machine_, rules_.zero, rules_.start);
    }
    SimulatedRun simulated = simulate_to_log(program_, machine_, rules_.start, progress_, rules_.zero);
    summary_before_ = std::move(simulated.summary);
    before_ = judge_run(std::move(simulated.log), program_, rules_.quality, diagnostics_, kinematics_);
}

bool Evaluator::has_time(double share) const {
    const auto one_run = static_cast<double>(before_.log.records);
    return (points_ == 0 || points_ + one_run <= share * most_points()) && in_vain_ < most_in_vain;
}

double Evaluator::most_points() const {
    const double size = std::min(1.0, static_cast<double>(before_.log.records) / large_run);
    return most_run_points * (1 - (1 - share_of_large) * size);
}

void Evaluator::allow_more_time() {
    more_time_ = rules_.more_time;
    points_ = std::min(points_, 0.5 * most_points());
    in_vain_ = 0;
    if (!best_) return;
    best_->evaluation.reason = objection(*best_);
    best_->evaluation.accepted = best_->evaluation.reason.empty();
}

TriedProposal Evaluator::propose(const std::shared_ptr<const Draft>& draft, std::vector<float> targets) {
    const auto tried = std::make_shared<Proposal>(prove(draft, std::move(targets)));
    ++in_vain_;
    if (!best_ || better(*tried, *best_)) {
        best_ = tried;
        in_vain_ = 0;
    }
    return tried;
}

Proposal Evaluator::prove(const std::shared_ptr<const Draft>& draft, std::vector<float> targets) {
    Proposal result;
    result.draft = draft;
    result.targets = std::move(targets);
    result.text = draft->text;
    Evaluation& evaluation = result.evaluation;
    evaluation.intervals = draft->segments;
    evaluation.changed_lines = draft->changed_lines;
    if (!result.targets.empty()) {
        LineEditor editor(draft->program);
        editor.set_feeds(equalised_feeds(result.targets, draft->may_slow, interval_width));
        result.text = editor.text("");
        evaluation.changed_lines += editor.changed_lines();
    }
    const Program changed = read_(result.text);
    evaluation.lines_before = program_.main().line_count();
    evaluation.lines_after = changed.main().line_count();
    SimulatedRun simulated;
    parallel_invoke([&] { simulated = simulate_to_log(changed, machine_, rules_.start, progress_, rules_.zero); },
                    [&] { evaluation.deviation = deviation_of(changed); });
    result.summary = std::move(simulated.summary);
    points_ += static_cast<double>(result.summary.points);
    // A cleaner run must not be judged more strictly for being cleaner.
    QualityRules as_before = rules_.quality;
    as_before.fixed = before_.report.thresholds;
    result.run = judge_run(std::move(simulated.log), changed, as_before, diagnostics_, kinematics_);
    evaluation.defects_before = before_.report.defects.size();
    evaluation.defects_after = result.run.report.defects.size();
    evaluation.reason = objection(result);
    evaluation.accepted = evaluation.reason.empty();
    return result;
}

Deviation Evaluator::deviation_of(const Program& changed) const {
    if (orientation_ == nullptr) return measure_deviation(program_, changed);
    const Orientation after(changed, machine_, rules_.zero, rules_.start);
    return measure_deviation(program_, changed, Deviation::usual_step, {orientation_.get(), &after});
}

/// Why a proposal cannot be taken; empty: it can.
std::string Evaluator::objection(const Proposal& p) const {
    if (p.evaluation.changed_lines == 0) return "no stretch of the program can be rewritten";
    if (p.evaluation.deviation.disordered > 0)
        return fmt::format("line {} would no longer do the same", p.evaluation.deviation.disordered);
    if (p.evaluation.deviation.greatest > rules_.tolerance)
        return fmt::format("it would leave the programmed path by {:.4f} mm at line {}",
                           p.evaluation.deviation.greatest, p.evaluation.deviation.line);
    if (p.evaluation.deviation.turned > most_turned)
        return fmt::format("it would turn the tool axis away from the programmed one by {:.4f} deg at line {}",
                           p.evaluation.deviation.turned * deg_per_rad, p.evaluation.deviation.turned_line);
    if (!p.summary.limits_ok)
        return summary_before_.limits_ok ? "the machine's limits would not be kept"
                                         : "the machine's limits are not kept, nor are they by the program as it is";
    if (p.run.mismatch >= before_.mismatch)
        return fmt::format("the speeds of neighbour passes would differ by {:.0f} instead of {:.0f} mm/min",
                           p.run.mismatch * seconds_per_minute, before_.mismatch * seconds_per_minute);
    if (p.evaluation.defects_after > p.evaluation.defects_before)
        return fmt::format("there would be {} defects instead of {}", p.evaluation.defects_after,
                           p.evaluation.defects_before);
    if (p.run.duration > longest())
        return fmt::format("it would take {:.3f} instead of {:.3f} s", p.run.duration, longest());
    return {};
}

double Evaluator::score(const Proposal& p) const {
    const double growth =
        static_cast<double>(p.evaluation.lines_after) / static_cast<double>(p.evaluation.lines_before);
    const double mismatch = p.run.mismatch / before_.mismatch,
                 defects = static_cast<double>(p.evaluation.defects_after) /
                           std::max<double>(1, static_cast<double>(p.evaluation.defects_before));
    const double later = std::clamp(p.run.duration / before_.duration - 1, 0.0, more_time_);
    return growth_weight * growth + std::max(mismatch, goal_of_mismatch) +
           beyond_goal * std::min(mismatch, goal_of_mismatch) + defects + later;
}

bool Evaluator::better(const Proposal& a, const Proposal& b) const {
    if (a.evaluation.accepted != b.evaluation.accepted) return a.evaluation.accepted;
    return score(a) < score(b);
}

}  // namespace clsurf

#include "repair/proposal.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/units.h"
#include "program/interpret/dialect_rules.h"
#include "repair/feeds/feed_equalisation.h"
#include "repair/line_edit.h"

namespace clsurf {
namespace {

// A sixth of the least threshold of a speed step, 3 % (docs/experiments/repair.md#the-search-in-detail, step 3).
constexpr double interval_width =
    0.005;  ///< share of the speeds in a constant-speed interval: adjacent passes may differ by as much
// Bounds on time and memory; the results depend on them (docs/experiments/repair.md#the-search-in-detail, Evaluation).
constexpr double most_run_points = 16e6;  ///< of all runs together; then the search ends …
constexpr double share_of_large = 0.25;   ///< … or less, down to this share, if a run is large
constexpr int most_since_best = 192;      ///< consecutive proposals without an improvement
// Four were too few: one machine of an ensemble refused them all (docs/experiments/kernel.md#what-made-the-difference).
constexpr std::size_t most_finalists = 16;          ///< of each kind …
constexpr double most_finalist_points = 4e6;        ///< … or as many as have this number of points together …
constexpr std::size_t most_finalists_of_large = 1;  ///< … and if runs are large, no more than this
/// Share of the time that feeds leave unused for the other machines. For candidates that use all of the time, the mean of the
/// machines is up to 0.03 % longer than before (docs/optimize.md#the-ensemble).
constexpr double time_reserve = 0.001;

std::string text_of(const LineOfEither& place) {
    return fmt::format("line {}{}", place.line, place.of_first ? " of the program as it was" : "");
}

double line_ratio(const Evaluation& e) {
    return static_cast<double>(e.lines_after) / static_cast<double>(e.lines_before);
}

std::string no_splines(SplineForm form) {
    return form == SplineForm::cubic_plane
               ? "no section can be written as a spline: G5 moves only X and Y, in the plane of G17, and needs fewer blocks than the lines"
               : "no section can be written as a spline with fewer blocks than its lines";
}

/// Whether two proposals are variants of one program, which other machines would also run alike.
bool runs_alike(const Proposal& a, const Proposal& b) {
    return a.evaluation.lines_after == b.evaluation.lines_after && a.run.duration == b.run.duration &&
           a.run.mismatch == b.run.mismatch && a.evaluation.defects_after == b.evaluation.defects_after;
}

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
    before_ = judge_run(std::move(simulated.log), program_, diagnostics_, kinematics_, ProgramIdentity::same,
                        rules_.derivative, rules_.needs_front());
}

bool Evaluator::has_time(double share) const {
    const auto one_run = static_cast<double>(before_.log.records);
    return (points_ == 0 || points_ + one_run <= share * most_points()) && since_best_ < most_since_best;
}

double Evaluator::longest() const {
    const double reserve = rules_.machines > 0 ? time_reserve : 0;
    return before_.duration * (1 + more_time_ - reserve);
}

double Evaluator::most_points() const {
    const double size = std::min(1.0, static_cast<double>(before_.log.records) / large_run);
    return most_run_points * (1 - (1 - share_of_large) * size);
}

double Evaluator::most_runs() const { return most_points() / static_cast<double>(before_.log.records); }

void Evaluator::allow_more_time() {
    more_time_ = rules_.more_time;
    points_ = std::min(points_, 0.5 * most_points());
    since_best_ = 0;
    if (!best_) return;
    best_->evaluation.reason = objection(*best_);
    best_->evaluation.accepted = best_->evaluation.reason.empty();
}

void Evaluator::report_progress(std::string_view what) const {
    if (progress_) progress_(what, std::min(1.0, points_ / most_points()));
}

std::string Evaluator::candidate_text() const {
    const RunMeasures was = before_.measures();
    if (!best_ || !(objective_mismatch(was, was) > 0)) return fmt::format("candidate {}", tried_);
    if (!best_->evaluation.accepted) return fmt::format("candidate {}, none is better so far", tried_);
    // Candidates compete by their gain; the mismatch alone may rise while defects are removed.
    const RunMeasures is = best_->measures();
    return fmt::format("candidate {}, best: gain {:.0f} %, {} defects, {:.1f} s", tried_,
                       100 * gain_of(measures_before(*best_), is, line_ratio(best_->evaluation), more_time_),
                       is.defects, is.duration);
}

TriedProposal Evaluator::propose(const std::shared_ptr<const Draft>& draft, std::vector<float> targets) {
    ++tried_;
    report_progress(candidate_text());
    const auto tried = std::make_shared<Proposal>(evaluate(draft, std::move(targets)));
    tried->number = tried_;
    if (rules_.needs_front()) keep_candidate(*tried);
    ++since_best_;
    if (!best_ || better(*tried, *best_)) {
        best_ = tried;
        since_best_ = 0;
    }
    if (tried->evaluation.accepted) keep_finalist(tried, tried->targets.empty() ? without_feeds_ : with_feeds_);
    return tried;
}

Proposal Evaluator::evaluate(const std::shared_ptr<const Draft>& draft, std::vector<float> targets) {
    Proposal result;
    result.draft = draft;
    result.targets = std::move(targets);
    result.text = draft->text;
    Evaluation& evaluation = result.evaluation;
    evaluation.intervals = draft->segments;
    evaluation.splines = draft->splines;
    evaluation.changed_lines = draft->changed_lines;
    if (!result.targets.empty()) {
        LineEditor editor(draft->program);
        editor.set_feeds(equalised_feeds(block_targets(result.targets, draft->merged), draft->may_slow, interval_width),
                         draft->splines > 0 ? draft->may_slow : std::vector<std::uint8_t>{});
        result.text = editor.text("");
        evaluation.changed_lines += editor.changed_lines();
    }
    const Program changed = read_(result.text);
    evaluation.lines_before = program_.main().line_count();
    evaluation.lines_after = changed.main().line_count();
    SimulatedRun simulated;
    parallel_invoke([&] { simulated = simulate_to_log(changed, machine_, rules_.start, {}, rules_.zero); },
                    [&] { evaluation.deviation = deviation_of(changed); });
    result.summary = std::move(simulated.summary);
    points_ += static_cast<double>(result.summary.points);
    result.run = judge_run(std::move(simulated.log), changed, diagnostics_, kinematics_, ProgramIdentity::same,
                           rules_.derivative, rules_.needs_front());
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

/// Why a proposal cannot be accepted; empty: it can.
std::string Evaluator::objection(const Proposal& p) const {
    return objection(p.evaluation, measures_before(p), p.measures(), p.summary.limits_ok);
}

std::string Evaluator::objection(const Evaluation& e, const RunMeasures& before, const RunMeasures& after,
                                 bool limits_ok) const {
    if (e.changed_lines == 0) return "no section of the program can be rewritten";
    if (rules_.splines && e.splines == 0) return no_splines(program_.dialect->rules->text.splines);
    if (e.deviation.disordered > 0)
        return fmt::format("line {} would no longer have the same effect", e.deviation.disordered);
    if (e.deviation.greatest > rules_.tolerance)
        return fmt::format("it would leave the programmed path by {:.4f} mm at {}", e.deviation.greatest,
                           text_of(e.deviation.line));
    if (e.deviation.turned > most_turned)
        return fmt::format("it would turn the tool axis away from the programmed one by {:.4f} deg at {}",
                           e.deviation.turned * deg_per_rad, text_of(e.deviation.turned_line));
    // Some controllers exceed the limits with any program, for example where blocks overlap in corners.
    if (!limits_ok && summary_before_.limits_ok) return "the machine's limits would not be kept";
    if (std::string reason = why_not_better(before, after, more_time_); !reason.empty()) return reason;
    return too_little_gain("the gain", gain_of(before, after, line_ratio(e), more_time_));
}

double Evaluator::score(const Proposal& p) const {
    return objective(measures_before(p), p.measures(), line_ratio(p.evaluation), more_time_);
}

void Evaluator::keep_finalist(const TriedProposal& proposal, std::vector<TriedProposal>& finalists) const {
    const auto points = static_cast<double>(before_.log.records);
    const std::size_t most = points >= large_run
                                 ? most_finalists_of_large
                                 : std::min(most_finalists, static_cast<std::size_t>(most_finalist_points / points));
    if (finalists.size() == most && !(score(*proposal) < score(*finalists.back()))) return;
    const auto same_run = [&](const TriedProposal& other) { return runs_alike(*proposal, *other); };
    if (std::any_of(finalists.begin(), finalists.end(), same_run)) return;
    const auto place = std::upper_bound(finalists.begin(), finalists.end(), proposal,
                                        [&](const TriedProposal& a, const TriedProposal& b) { return better(*a, *b); });
    finalists.insert(place, proposal);
    if (finalists.size() > most) finalists.pop_back();
}

RunMeasures Proposal::measures() const {
    return roughness ? with_roughness(run.measures(), roughness->after) : run.measures();
}

RunMeasures Evaluator::measures_before(const Proposal& proposal) const {
    return proposal.roughness ? with_roughness(before_.measures(), proposal.roughness->before) : before_.measures();
}

void Evaluator::measure_roughness(const CuttingTool& tool) {
    const RoughnessGauge gauge(before_.gauged(), tool);
    roughness_before_ = gauge.before();
    for (const TriedProposal& each : finalists()) {
        each->roughness = gauge.change_to(each->run.gauged());
        each->evaluation.reason = objection(*each);
        each->evaluation.accepted = each->evaluation.reason.empty();
    }
}

std::vector<TriedProposal> Evaluator::finalists() const {
    if (!preferred_.empty()) return preferred_;
    std::vector<TriedProposal> all = with_feeds_;
    all.insert(all.end(), without_feeds_.begin(), without_feeds_.end());
    std::stable_sort(all.begin(), all.end(),
                     [&](const TriedProposal& a, const TriedProposal& b) { return better(*a, *b); });
    return all;
}

bool Evaluator::better(const Proposal& a, const Proposal& b) const {
    if (a.evaluation.accepted != b.evaluation.accepted) return a.evaluation.accepted;
    // A proposal without splines would be refused for that reason, which says nothing about proposals with splines.
    const bool has = a.evaluation.splines > 0, other_has = b.evaluation.splines > 0;
    if (rules_.splines && has != other_has) return has;
    return score(a) < score(b);
}

}  // namespace clsurf

#include "optimize/optimizer.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.h"
#include "core/statistics.h"
#include "core/units.h"
#include "optimize/levelling.h"
#include "optimize/line_edit.h"
#include "optimize/need.h"
#include "optimize/resample.h"

namespace clsurf {
namespace {

constexpr std::array<double, 3> shares_of_tolerance{0.2, 0.1, 0.4};  ///< that lines may leave the curve by
constexpr double block_reserve = 1.1;    ///< of the way in a block time
constexpr std::array<double, 7> steps_between_passes{0.35, 0.2, 0.1, 0.07, 0.05, 0.035, 0.02};
constexpr double play_of_feeds = 0.01;   ///< a motion this little too fast (a share) gets no feed
constexpr double interval_width = 0.03;  ///< of the speeds in a constant-speed interval
constexpr double growth_weight = 0.1;   ///< of a program's growth, against shares of mismatch and defects
constexpr double most_points = 8e6;      ///< of all runs together; then what there is has to do

/// A run of a proposal, and how it holds against the program.
struct Tried {
    Proof proof;
    std::string text;
    JudgedRun run;
    SimulationSummary summary;
};

/// The thresholds that one run was judged by, as fixed rules for another: a cleaner run must not be judged
/// more strictly for being cleaner.
QualityRules as_judged(const QualityReport& report, QualityRules rules) {
    const auto threshold = [&](Quantity q) { return report.thresholds.of[index_of(q)]; };
    rules.thresholds.speed = std::max(rules.thresholds.speed, threshold(Quantity::speed));
    if (report.thresholds.usual_acceleration > 0) rules.thresholds.acceleration = std::max(rules.thresholds.acceleration, threshold(Quantity::acceleration) / report.thresholds.usual_acceleration);
    rules.thresholds.most = 1;
    return rules;
}

/// The median feed of the cutting lines [mm/s].
double usual_feed(const Program& program) {
    std::vector<double> feeds;
    for (std::int64_t i = 0; i < program.motions.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (program.motions.kind[k] == MotionKind::feed && program.motions.feed[k] > 0) feeds.push_back(program.motions.feed[k]);
    }
    return feeds.empty() ? 0 : median(feeds);
}

class Optimizer {
public:
    Optimizer(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics)
        : program_(program), read_(read), machine_(machine), rules_(rules), progress_(progress), diagnostics_(diagnostics) {}

    Optimized run(std::optional<Log> measured) {
        Optimized result;
        if (measured) result.measured = judge_measured(std::move(*measured));
        SimulatedRun simulated = simulate_to_log(program_, machine_, rules_.start, progress_);
        result.run_before = std::move(simulated.summary);
        result.before = judge_run(std::move(simulated.log), program_, rules_.quality, diagnostics_);
        if (result.before.surface.step_over <= 0) throw InputError(Place::of_file(program_.main().name()), "has no passes beside each other: there is nothing to bring into step");
        fixed_ = as_judged(result.before.report, rules_.quality);
        before_ = &result.before;
        defects_before_ = find_defects(before_->surface, before_->signals, *before_->lines, program_, machine_.controller.period, fixed_).defects.size();
        const ProgrammedSurface laid = lay_out(program_);
        if (!measured_) needed_ = motions_in_need(result.before, program_, {});
        shortest_line_ = block_reserve * machine_.controller.block_time * usual_feed(program_);
        std::optional<Tried> best;
        const auto keep = [&](Tried tried) {
            if (!best || better(tried, *best)) best = std::move(tried);
        };
        for (const double share : shares_of_tolerance) {
            // What is tried last is left out first where a program is long.
            if (points_ >= most_points) break;
            const Base base = resampled(laid, share * rules_.tolerance);
            if (base.stretches > 0) propose_for(base, keep);
        }
        if (!best || points_ < most_points) propose_for({program_, std::string(program_.main().text()), true, 0, 0, measured_ ? needed_ : std::vector<std::uint8_t>{}}, keep);
        result.proof = std::move(best->proof);
        result.text = std::move(best->text);
        result.after = std::move(best->run);
        result.run_after = std::move(best->summary);
        return result;
    }

private:
    /// A program whose points were moved (or none), before feeds are set.
    struct Base {
        Program program;
        std::string text;
        bool original = false;
        std::size_t stretches = 0, changed_lines = 0;
        std::vector<std::uint8_t> may_slow;  ///< per motion, whether it may get a feed; empty: all may
    };

    Measured judge_measured(Log log) {
        const JudgedRun run = judge_run(std::move(log), program_, rules_.quality, diagnostics_);
        if (run.surface.step_over <= 0) throw InputError(Place::of_file(run.log.name), "has no passes beside each other: it does not tell what is out of step");
        needed_ = motions_in_need(run, program_, {});
        measured_ = true;
        return {run.surface.positions.size(), run.duration, run.mismatch, run.report.defects.size(), static_cast<std::size_t>(std::count(needed_.begin(), needed_.end(), 1))};
    }

    /// The points alone, then with feeds that bring neighbour passes within a step of each other.
    template <typename Keep>
    void propose_for(const Base& base, const Keep& keep) {
        Tried plain = prove(base, base.text, 0);
        const std::vector<float> own = means_by_motion(plain.run, base.program, speeds_of(plain.run));
        std::vector<std::vector<float>> targets;
        for (const double step : steps_between_passes) targets.push_back(means_by_motion(plain.run, base.program, levelled_speeds(plain.run, step)));
        keep(std::move(plain));
        for (const std::vector<float>& target : targets) {
            if (points_ >= most_points) return;
            LineEditor editor(base.program);
            editor.set_feeds(levelling_feeds(own, target, base.may_slow, play_of_feeds, interval_width));
            Tried levelled = prove(base, editor.text(base.original ? rules_.header : ""), editor.changed_lines());
            const bool too_slow = levelled.run.duration > before_->duration;
            keep(std::move(levelled));
            if (too_slow) return;  // lower feeds take longer still
        }
    }

    static std::vector<float> speeds_of(const JudgedRun& run) {
        std::vector<float> speeds(run.signals.samples.size());
        for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] = run.signals.samples[i].speed;
        return speeds;
    }

    Base resampled(const ProgrammedSurface& laid, double chord_error) {
        Base base;
        const double spacing = 0.5 * fitting_spacing(program_, laid, chord_error);
        LineEditor editor(program_, rules_.least_decimals);
        const std::vector<Stretch> stretches = resample(program_, laid, editor, {rules_.tolerance, spacing, chord_error, shortest_line_, ResampleRules{}.corner_angle}, needed_);
        std::int64_t old = 0;  // motions so far
        for (const Stretch& stretch : stretches) {
            const std::size_t lines = editor.replace(stretch.first, stretch.last, stretch.points);
            if (!measured_) continue;
            base.may_slow.insert(base.may_slow.end(), needed_.begin() + old, needed_.begin() + stretch.first);
            base.may_slow.insert(base.may_slow.end(), lines, 1);
            old = stretch.last + 1;
        }
        if (measured_) base.may_slow.insert(base.may_slow.end(), needed_.begin() + old, needed_.end());
        base.text = editor.text(rules_.header);
        base.program = read_(base.text);
        base.stretches = stretches.size();
        base.changed_lines = editor.changed_lines();
        return base;
    }

    Tried prove(const Base& base, const std::string& text, std::size_t feed_lines) {
        Tried tried;
        tried.text = text;
        const Program changed = read_(tried.text);
        tried.proof.intervals = base.stretches;
        tried.proof.changed_lines = base.changed_lines + feed_lines;
        tried.proof.lines_before = program_.main().line_count();
        tried.proof.lines_after = changed.main().line_count();
        tried.proof.deviation = measure_deviation(program_, changed);
        SimulatedRun simulated = simulate_to_log(changed, machine_, rules_.start, progress_);
        tried.summary = std::move(simulated.summary);
        points_ += static_cast<double>(tried.summary.points);
        tried.run = judge_run(std::move(simulated.log), changed, fixed_, diagnostics_);
        tried.proof.defects_before = defects_before_;
        tried.proof.defects_after = tried.run.report.defects.size();
        tried.proof.reason = objection(tried);
        tried.proof.accepted = tried.proof.reason.empty();
        return tried;
    }

    /// Why a proposal cannot be taken; empty: it can.
    [[nodiscard]] std::string objection(const Tried& t) const {
        if (t.proof.changed_lines == 0) return "no stretch of the program can be rewritten";
        if (t.proof.deviation.disordered > 0) return fmt::format("line {} would no longer do the same", t.proof.deviation.disordered);
        if (t.proof.deviation.greatest > rules_.tolerance) return fmt::format("it would leave the programmed path by {:.4f} mm at line {}", t.proof.deviation.greatest, t.proof.deviation.line);
        if (!t.summary.limits_ok) return "the machine's limits would not be kept";
        if (t.run.mismatch >= before_->mismatch) return fmt::format("the speeds of neighbour passes would differ by {:.0f} instead of {:.0f} mm/min", t.run.mismatch * seconds_per_minute, before_->mismatch * seconds_per_minute);
        if (t.proof.defects_after > t.proof.defects_before) return fmt::format("there would be {} defects instead of {}", t.proof.defects_after, t.proof.defects_before);
        if (t.run.duration > before_->duration) return fmt::format("it would take {:.3f} instead of {:.3f} s", t.run.duration, before_->duration);
        return {};
    }

    /// What is left of mismatch and defects, as shares; of two that are nearly as good the shorter program wins.
    [[nodiscard]] double score(const Tried& t) const {
        const double growth = static_cast<double>(t.proof.lines_after) / static_cast<double>(t.proof.lines_before);
        return growth_weight * growth + t.run.mismatch / before_->mismatch + static_cast<double>(t.proof.defects_after) / std::max<double>(1, static_cast<double>(defects_before_));
    }

    [[nodiscard]] bool better(const Tried& a, const Tried& b) const {
        if (a.proof.accepted != b.proof.accepted) return a.proof.accepted;
        return score(a) < score(b);
    }

    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    const Progress& progress_;
    Diagnostics& diagnostics_;
    QualityRules fixed_;
    std::vector<std::uint8_t> needed_;  ///< one entry a motion
    bool measured_ = false;             ///< that tells a recorded run
    double shortest_line_ = 0;          ///< [mm] below which blocks take longer than their way
    const JudgedRun* before_ = nullptr;
    std::size_t defects_before_ = 0;
    double points_ = 0;  ///< simulated so far
};

}  // namespace

Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, std::optional<Log> measured, const Progress& progress, Diagnostics& diagnostics) {
    return Optimizer(program, read, machine, rules, progress, diagnostics).run(std::move(measured));
}

}  // namespace clsurf

#include "optimize/optimizer.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "optimize/line_edit.h"
#include "optimize/resample.h"

namespace clsurf {
namespace {

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

class Optimizer {
public:
    Optimizer(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics)
        : program_(program), read_(read), machine_(machine), rules_(rules), progress_(progress), diagnostics_(diagnostics) {}

    Optimized run() {
        Optimized result;
        SimulatedRun simulated = simulate_to_log(program_, machine_, rules_.start, progress_);
        result.run_before = std::move(simulated.summary);
        result.before = judge_run(std::move(simulated.log), program_, rules_.quality, diagnostics_);
        if (result.before.surface.step_over <= 0) throw InputError(Place::of_file(program_.main().name()), "has no passes beside each other: there is nothing to bring into step");
        fixed_ = as_judged(result.before.report, rules_.quality);
        before_ = &result.before;
        defects_before_ = find_defects(before_->surface, before_->signals, *before_->lines, program_, machine_.controller.period, fixed_).defects.size();
        const ProgrammedSurface laid = lay_out(program_);
        std::optional<Tried> best;
        for (const double share : {1.0, 0.7, 1.4}) {
            Tried tried = try_spacing(laid, share * fitting_spacing(program_, laid, rules_.tolerance));
            if (!best || better(tried, *best)) best = std::move(tried);
        }
        result.proof = std::move(best->proof);
        result.text = std::move(best->text);
        result.after = std::move(best->run);
        result.run_after = std::move(best->summary);
        return result;
    }

private:
    Tried try_spacing(const ProgrammedSurface& laid, double spacing) {
        Tried tried;
        LineEditor editor(program_);
        const std::vector<Stretch> stretches = resample(program_, laid, editor, {rules_.tolerance, spacing, ResampleRules{}.corner_angle});
        for (const Stretch& stretch : stretches) editor.replace(stretch.first, stretch.last, stretch.points);
        tried.text = editor.text(rules_.header);
        const Program changed = read_(tried.text);
        tried.proof.intervals = stretches.size();
        tried.proof.changed_lines = editor.changed_lines();
        tried.proof.lines_before = program_.main().line_count();
        tried.proof.lines_after = changed.main().line_count();
        tried.proof.deviation = measure_deviation(program_, changed);
        SimulatedRun simulated = simulate_to_log(changed, machine_, rules_.start, progress_);
        tried.summary = std::move(simulated.summary);
        tried.run = judge_run(std::move(simulated.log), changed, fixed_, diagnostics_);
        tried.proof.defects_before = defects_before_;
        tried.proof.defects_after = tried.run.report.defects.size();
        tried.proof.reason = objection(tried);
        tried.proof.accepted = tried.proof.reason.empty();
        return tried;
    }

    /// Why a proposal cannot be taken; empty: it can.
    [[nodiscard]] std::string objection(const Tried& t) const {
        if (t.proof.intervals == 0) return "no stretch of the program can be rewritten";
        if (t.proof.deviation.disordered > 0) return fmt::format("line {} would no longer do the same", t.proof.deviation.disordered);
        if (t.proof.deviation.greatest > rules_.tolerance) return fmt::format("it would leave the programmed path by {:.4f} mm", t.proof.deviation.greatest);
        if (!t.summary.limits_ok) return "the machine's limits would not be kept";
        if (t.run.mismatch >= before_->mismatch) return fmt::format("the speeds of neighbour passes would differ by {:.0f} instead of {:.0f} mm/min", t.run.mismatch * seconds_per_minute, before_->mismatch * seconds_per_minute);
        if (t.proof.defects_after > t.proof.defects_before) return fmt::format("there would be {} defects instead of {}", t.proof.defects_after, t.proof.defects_before);
        if (t.run.duration > before_->duration) return fmt::format("it would take {:.3f} instead of {:.3f} s", t.run.duration, before_->duration);
        return {};
    }

    [[nodiscard]] static bool better(const Tried& a, const Tried& b) {
        if (a.proof.accepted != b.proof.accepted) return a.proof.accepted;
        return a.run.mismatch < b.run.mismatch;
    }

    const Program& program_;
    const ReadProgram& read_;
    const Machine& machine_;
    const OptimizeRules& rules_;
    const Progress& progress_;
    Diagnostics& diagnostics_;
    QualityRules fixed_;
    const JudgedRun* before_ = nullptr;
    std::size_t defects_before_ = 0;
};

}  // namespace

Optimized optimize(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules, const Progress& progress, Diagnostics& diagnostics) {
    return Optimizer(program, read, machine, rules, progress, diagnostics).run();
}

}  // namespace clsurf

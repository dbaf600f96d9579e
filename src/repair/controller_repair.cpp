#include "repair/controller_repair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "pipeline/roughness_gauge.h"

namespace clsurf {
namespace {

// The limits of docs/optimize.md#your-controller-as-the-judge. For comparison, a kernel kept the promised times within 0.1 %,
// once within 0.5 % (docs/experiments/kernel.md#promised-and-kept).
constexpr double promise_tolerance = 0.05;  ///< share of the run before by which mismatch and defects may differ
constexpr double most_missing = 0.02;       ///< share of the program's motions that may be missing in a log
constexpr double time_tolerance = 0.005;    ///< the same as promise_tolerance, for the time

bool keeps(const RunMeasures& before, const RunMeasures& promised, const RunMeasures& measured) {
    const double mismatch = std::abs(measured.mismatch - promised.mismatch) / std::max(before.mismatch, 1e-9),
                 defects = std::abs(measured.defects - promised.defects) / std::max(before.defects, 1.0),
                 time = std::abs(measured.duration - promised.duration) / before.duration;
    return mismatch <= promise_tolerance && defects <= promise_tolerance && time <= time_tolerance;
}

class ControllerRepair {
public:
    ControllerRepair(const Program& program, const ReadProgram& read, const Machine& known, OptimizeRules rules,
                     const ControllerJudge& judge, const Progress& progress, Diagnostics& diagnostics)
        : program_(program),
          read_(read),
          known_(known),
          rules_(std::move(rules)),
          judge_(judge),
          progress_(progress),
          diagnostics_(diagnostics) {
        rules_.all_finalists = true;
    }

    Optimized run(std::optional<Log> measured, const std::vector<EarlierRound>& rounds) {
        const std::string text(program_.main().text());
        if (!measured) {
            ControllerOutcome outcome = judge_.run(text);
            if (!outcome.log) refuse(outcome.failure);
            measured = std::move(outcome.log);
            runs_.push_back({.candidate = 0});
        }
        logs_.push_back({text, *measured});
        before_ = judged(Log(*measured), program_);
        if (const std::string reason = why_unusable(before_); !reason.empty()) refuse(reason);
        if (before_.surface.step_over <= 0)
            throw InputError(Place::of_file(measured->name),
                             "has no adjacent passes: it does not show which passes differ");
        if (rules_.tool) gauge_.emplace(before_.gauged(), *rules_.tool);
        most_runs_ = judge_.runs;
        if (runs_.empty() && !rounds.empty()) {
            runs_.push_back({.candidate = 0});
            ++most_runs_;
        }
        if (!runs_.empty()) runs_.back().measured = before_.measures();
        for (const EarlierRound& round : rounds) take_round(round);
        Optimized result = judge_.run ? search(*measured) : simulated(*measured);
        result.on_controller = after_judged_;
        result.controller_runs = runs_;
        if (!after_judged_) return result;
        if (roughness_) {
            result.roughness_before = std::move(roughness_->before);
            result.roughness_after = std::move(roughness_->after);
        }
        result.before = std::move(before_);
        result.after = std::move(after_);
        // For the runs that are shown, whether the candidate was accepted or not.
        result.evaluation.defects_before = result.before.report.defects.size();
        result.evaluation.defects_after = result.after.report.defects.size();
        return result;
    }

private:
    [[nodiscard]] bool has_runs() const { return static_cast<int>(runs_.size()) < most_runs_; }

    /// The measures of the program and of a run.
    struct Comparison {
        RunMeasures before, after;
        std::optional<RoughnessChange> roughness{};  ///< if the tool is known
    };

    [[nodiscard]] Comparison compare(const JudgedRun& run) const {
        Comparison result{before_.measures(), run.measures()};
        if (!gauge_) return result;
        result.roughness = gauge_->change_to(run.gauged());
        result.before = with_roughness(result.before, result.roughness->before);
        result.after = with_roughness(result.after, result.roughness->after);
        return result;
    }

    /// `reason`: why a run is not better than the run of the program; empty: it is.
    [[nodiscard]] double gain_over_program(const Comparison& runs, LineNumber lines, std::string& reason) const {
        const auto& [before, after, roughness] = runs;
        const double ratio = static_cast<double>(lines) / static_cast<double>(program_.main().line_count());
        const double gain = gain_of(before, after, ratio, rules_.more_time);
        reason = why_not_better(before, after, rules_.more_time);
        if (reason.empty()) reason = too_little_gain("the gain", gain);
        return gain;
    }

    [[nodiscard]] JudgedRun judged(Log log, const Program& program) {
        return judge_run(std::move(log), program, diagnostics_, nullptr, ProgramIdentity::unknown, rules_.derivative);
    }

    /// Why a log does not represent a run of the program; empty: it does.
    [[nodiscard]] static std::string why_unusable(const JudgedRun& run) {
        const ProgramMatch& match = run.lines->match();
        if (!match.foreign.empty()) return "the log does not belong to the program: " + match.foreign;
        if (match.missing > most_missing)
            return fmt::format("the log lacks {:.1f} % of the program", 100 * match.missing);
        return {};
    }

    [[noreturn]] void refuse(const std::string& failure) const {
        throw InputError(Place::of_file(program_.main().name()), "the controller did not run it: " + failure);
    }

    /// Includes the log of an earlier round.
    void take_round(const EarlierRound& round) {
        const Program changed = read_(round.run.text);
        const JudgedRun after = judged(Log(round.run.log), changed);
        if (const std::string reason = why_unusable(after); !reason.empty())
            throw InputError(Place::of_file(round.run.log.name), "is not a run of " + round.name + ": " + reason);
        logs_.push_back(round.run);
        ++most_runs_;
        ControllerRun run{.candidate = 0, .round = round.name};
        const Comparison runs = compare(after);
        run.measured = runs.after;
        const double gain = gain_over_program(runs, changed.main().line_count(), run.reason);
        run.accepted = run.reason.empty();
        runs_.push_back(run);
        if (!run.accepted || gain <= best_gain_) return;
        best_gain_ = gain;
        best_round_ = round.name;
    }

    /// The best candidate of the simulation, if it promises more than the earlier rounds gained.
    Optimized simulated(const Log& measured) {
        Optimized found = optimize(program_, read_, judge_.fit(logs_, known_), rules_, std::optional<Log>(measured),
                                   progress_, diagnostics_);
        if (!found.evaluation.accepted || best_round_.empty()) return found;
        RunMeasures before = found.before.measures(), after = found.after.measures();
        if (found.roughness_before && found.roughness_after) {
            before = with_roughness(before, *found.roughness_before);
            after = with_roughness(after, *found.roughness_after);
        }
        const double ratio =
            static_cast<double>(found.evaluation.lines_after) / static_cast<double>(found.evaluation.lines_before);
        const double gain = gain_of(before, after, ratio, rules_.more_time);
        if (gain >= best_gain_ + least_gain) return found;
        found.evaluation.accepted = false;
        found.evaluation.reason =
            fmt::format("{0} gained {1:.1f} % on the machine, and the best candidate promises {2:.1f} %: keep {0}",
                        best_round_, 100 * best_gain_, 100 * gain);
        return found;
    }

    /// Searches with the machine fitted to the logs so far, until a candidate keeps its promise or no run remains.
    Optimized search(const Log& measured) {
        Optimized result;
        Machine machine = judge_.fit(logs_, known_);
        while (true) {
            Optimized found =
                optimize(program_, read_, machine, rules_, std::optional<Log>(measured), progress_, diagnostics_);
            const bool learned = try_finalists(found, result);
            if (!result.evaluation.accepted) {
                if (found.evaluation.accepted || candidates_ > 0) found.evaluation.reason = refusal_;
                found.evaluation.accepted = false;
                result = std::move(found);
            }
            if (!learned || !has_runs()) return result;
            machine = judge_.fit(logs_, known_);
        }
    }

    /// Runs candidates until one meets the prediction of the simulation. Returns true if a candidate did not, so that the
    /// machine can be fitted again.
    bool try_finalists(const Optimized& found, Optimized& result) {
        for (const Finalist& finalist : found.finalists) {
            if (!has_runs()) return false;
            const auto same = [&](const ControllerLog& each) { return each.text == finalist.text; };
            if (std::any_of(logs_.begin(), logs_.end(), same)) continue;
            const std::optional<RunMeasures> measured = try_one(finalist, found, result);
            if (!measured) continue;
            if (!keeps(before_.measures(), finalist.promised, *measured)) return true;
            if (runs_.back().accepted) return false;
        }
        return false;
    }

    std::optional<RunMeasures> try_one(const Finalist& finalist, const Optimized& found, Optimized& result) {
        ControllerRun run{.candidate = ++candidates_, .promised = finalist.promised};
        run.reason = take_outcome(finalist, found, judge_.run(finalist.text), run, result);
        runs_.push_back(run);
        return run.measured;
    }

    /// Judges the log of a candidate. Returns why it is not accepted.
    std::string take_outcome(const Finalist& finalist, const Optimized& found, ControllerOutcome outcome,
                             ControllerRun& run, Optimized& result) {
        if (!outcome.log) return refusal_ = outcome.failure;
        JudgedRun after = judged(Log(*outcome.log), read_(finalist.text));
        if (const std::string reason = why_unusable(after); !reason.empty()) return refusal_ = reason;
        logs_.push_back({finalist.text, std::move(*outcome.log)});
        run.measured = after.measures();
        return take(finalist, found, std::move(after), run, result);
    }

    /// Accepts a candidate whose log is better than the logs of the program and of the previous candidates. Returns why it is
    /// not accepted.
    std::string take(const Finalist& finalist, const Optimized& found, JudgedRun after, ControllerRun& run,
                     Optimized& result) {
        Comparison runs = compare(after);
        std::string reason;
        const double gain = gain_over_program(runs, finalist.evaluation.lines_after, reason);
        if (reason.empty() && !best_round_.empty() && gain < best_gain_ + least_gain)
            reason =
                fmt::format("it gains {:.1f} %, and {} gained {:.1f} %", 100 * gain, best_round_, 100 * best_gain_);
        run.accepted = reason.empty();
        if (!run.accepted) refusal_ = "on the controller, " + reason;
        const bool better = run.accepted && (!result.evaluation.accepted || gain > best_gain_);
        if (!better && after_judged_) return reason;
        after_ = std::move(after);
        roughness_ = std::move(runs.roughness);
        after_judged_ = true;
        if (!better) return reason;
        best_gain_ = gain;
        best_round_.clear();
        result.text = finalist.text;
        result.evaluation = finalist.evaluation;
        result.ensemble = finalist.ensemble;
        result.fidelity = found.fidelity;
        result.measured = found.measured;
        return reason;
    }

    const Program& program_;
    const ReadProgram& read_;
    const Machine& known_;
    OptimizeRules rules_;
    const ControllerJudge& judge_;
    const Progress& progress_;
    Diagnostics& diagnostics_;
    std::vector<ControllerLog> logs_;
    std::vector<ControllerRun> runs_;
    JudgedRun before_, after_;
    std::optional<RoughnessGauge> gauge_;       ///< of before_, if the tool is known
    std::optional<RoughnessChange> roughness_;  ///< to after_
    bool after_judged_ = false;
    int candidates_ = 0;
    int most_runs_ = 0;
    double best_gain_ = 0;    ///< of the runs so far
    std::string best_round_;  ///< file of the earlier round with this gain; empty: none
    std::string refusal_ = "no candidate was better on the simulated machines";
};

}  // namespace

Optimized optimize_on_controller(const Program& program, const ReadProgram& read, const Machine& machine,
                                 OptimizeRules rules, const ControllerJudge& judge, std::optional<Log> measured,
                                 const std::vector<EarlierRound>& rounds, const Progress& progress,
                                 Diagnostics& diagnostics) {
    return ControllerRepair(program, read, machine, std::move(rules), judge, progress, diagnostics)
        .run(std::move(measured), rounds);
}

}  // namespace clsurf

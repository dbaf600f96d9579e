#include "repair/ensemble.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/parallel.h"
#include "pipeline/simulated_log.h"

namespace clsurf {
namespace {

void add(const RunMeasures& each, double weight, RunMeasures& sum) {
    sum.mismatch += weight * each.mismatch;
    sum.defect_mismatch += weight * each.defect_mismatch;
    sum.defects += weight * each.defects;
    sum.duration += weight * each.duration;
    sum.speed += weight * each.speed;
}

double line_ratio(const Program& before, const Program& after) {
    return static_cast<double>(after.main().line_count()) / static_cast<double>(before.main().line_count());
}

}  // namespace

const EnsembleRun& EnsembleResult::worst() const {
    return *std::min_element(runs.begin(), runs.end(),
                             [](const EnsembleRun& a, const EnsembleRun& b) { return a.gain < b.gain; });
}

EnsembleRun EnsembleResult::mean() const {
    EnsembleRun sum;
    const double weight = 1 / static_cast<double>(runs.size());
    for (const EnsembleRun& run : runs) {
        add(run.before, weight, sum.before);
        add(run.after, weight, sum.after);
        sum.gain += weight * run.gain;
    }
    return sum;
}

std::string why_not_better(const EnsembleResult& result, double more_time) {
    if (result.runs.empty()) return {};
    const EnsembleRun mean = result.mean();
    if (const std::string reason = why_not_better(mean.before, mean.after, more_time); !reason.empty())
        return fmt::format("on the mean of {} machines within the uncertainty of the machine file, {}",
                           result.runs.size(), reason);
    const std::string what =
        fmt::format("the mean gain on {} machines within the uncertainty of the machine file", result.runs.size());
    if (std::string reason = too_little_gain(what, mean.gain); !reason.empty()) return reason;
    const std::string on_one =
        fmt::format("on one of {} machines within the uncertainty of the machine file, ", result.runs.size());
    for (const EnsembleRun& run : result.runs) {
        const double longest = run.before.duration * (1 + more_time + most_time_on_one_machine);
        if (run.after.duration > longest)
            return on_one +
                   fmt::format("it would take {:.3f} instead of {:.3f} s", run.after.duration, run.before.duration);
        if (run.after.defects > run.before.defects)
            return on_one + fmt::format("there would be {:.0f} defects instead of {:.0f}", run.after.defects,
                                        run.before.defects);
        if (run.gain < 0)
            return on_one + fmt::format(
                                "the objective would rise by {:.2g} %: {:.0f} defects instead of {:.0f}, speed "
                                "differences of {:.0f} instead of {:.0f} mm/min",
                                -100 * run.gain, run.after.defects, run.before.defects,
                                objective_mismatch(run.before, run.after) * seconds_per_minute,
                                objective_mismatch(run.before, run.before) * seconds_per_minute);
    }
    return {};
}

Ensemble::Ensemble(const Program& program, std::vector<Machine> machines, const OptimizeRules& rules,
                   std::shared_ptr<const Kinematics> kinematics)
    : program_(program), machines_(std::move(machines)), rules_(rules), kinematics_(std::move(kinematics)) {}

JudgedRun Ensemble::judged(const Program& program, const Machine& machine) const {
    Diagnostics of_mapping;  // not reported, unlike the diagnostics of the nominal machine
    const std::shared_ptr<const Kinematics> kinematics =
        kinematics_ == nullptr ? nullptr : std::make_shared<const Kinematics>(machine.kinematics);
    return judge_run(simulate_to_log(program, machine, rules_.start, {}, rules_.zero).log, program, of_mapping,
                     kinematics, ProgramIdentity::same, rules_.derivative);
}

EnsembleResult Ensemble::run(const Program& changed) {
    EnsembleResult result;
    result.runs.resize(machines_.size());
    const bool first = before_.empty();
    before_.resize(machines_.size());
    const double ratio = line_ratio(program_, changed);
    parallel_for(static_cast<std::int64_t>(machines_.size()), 1, [&](std::int64_t from, std::int64_t to) {
        for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k) {
            if (first) before_[k] = judged(program_, machines_[k]).measures();
            EnsembleRun& run = result.runs[k];
            run.before = before_[k];
            run.after = judged(changed, machines_[k]).measures();
            run.gain = gain_of(run.before, run.after, ratio, rules_.more_time);
        }
    });
    return result;
}

}  // namespace clsurf

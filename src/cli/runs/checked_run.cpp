#include "cli/runs/checked_run.h"

#include <utility>

#include "io/reports/simulation_origin.h"
#include "pipeline/limits_of.h"

namespace clsurf::cli {

CheckedRun check_run(const PartOptions& options, std::optional<Role> measured, const CheckBudget& budget,
                     StageClock& clock, bool with_motion, const std::optional<MergedShards>& merged) {
    CheckedRun run;
    run.part = load_part(options, clock);
    if (merged) {
        run.survey = merged->survey;
        run.quality = judge_merged(*merged, run.part, measured, with_motion, clock, run.surface);
    } else {
        clock.begin("stitch the surface");
        run.surface = stitch(run.part);
        run.quality = judge(run.part, run.surface, measured, {}, clock.stages(), with_motion);
    }
    run.part.diagnostics.append(run.quality.diagnostics);
    if (const std::vector<StatedLimit> stated = stated_limits(run.part.limits, budget); !stated.empty()) {
        clock.begin("compare with the limits");
        run.limits = judge_limits(run.part, stated);
        run.part.diagnostics.append(run.limits.diagnostics);
    }
    run.states_limits = !options.machine.empty() || budget.limits.max_following_error_um;
    if (budget.accepted) {
        run.acceptance = io::accept(run.quality.report, *budget.accepted);
        io::note_changes(*run.acceptance, run.quality.report, run.part.diagnostics);
    }
    run.budget = hold(run.acceptance ? io::without_accepted(run.quality.report, *run.acceptance) : run.quality.report,
                      budget.quality);
    const std::vector<BudgetLine> held = hold(run.limits, budget.limits);
    run.budget.insert(run.budget.end(), held.begin(), held.end());
    run.code = code_of(run.quality.report.judgement.judged(), run.budget, held, budget);
    clock.end();
    return run;
}

io::ReportedQuality reported_of(const CheckedRun& run) {
    io::ReportedQuality reported;
    reported.report = &run.quality.report;
    reported.program = &run.part.program;
    reported.log = run.part.log.name;
    reported.tool = run.part.tool;
    reported.scallop = run.quality.scallop;
    reported.as_machined = run.quality.as_machined ? &*run.quality.as_machined : nullptr;
    reported.motion = run.quality.motion;
    if (run.states_limits) reported.limits = &run.limits;
    reported.budget = run.budget;
    reported.origin = io::simulation_origin(run.part.log);
    reported.acceptance = run.acceptance ? &*run.acceptance : nullptr;
    reported.diagnostics = &run.part.diagnostics;
    return reported;
}

void declare_judging(po::options_description& options) {
    declare_tool(options);
    // clang-format off
    options.add_options()
        ("budget", po::value<std::string>()->value_name("FILE"), "limits (TOML); exit code 1 if one is exceeded; max_speed_mismatch_percent limits the speed jump of each defect and the speed differences of the whole part (docs/predictor.md)")
        ("fail-on", po::value<std::string>()->value_name(severity_words), "exit code 1 if a defect has at least this severity")
        ("accepted", po::value<std::string>()->value_name("FILE"), "accepted defects (JSON, from the page of report): they are listed, but do not count towards any limit")
        ("max-depth", po::value<std::string>()->value_name("LENGTH"), "exit code 1 if a defect is deeper, for example 5um or 0.005mm");
    // clang-format on
    declare_part(options, MachineUse::limits);
    declare_derivative(options);
}

}  // namespace clsurf::cli

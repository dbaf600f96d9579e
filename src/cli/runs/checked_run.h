#pragma once
// CheckedRun: a program and a log of it, judged as `check` does it: passes, limits of the machine, budget.

#include <memory>
#include <optional>
#include <vector>

#include "cli/options/part.h"
#include "cli/runs/merged_shards.h"
#include "cli/runs/quality_limits.h"
#include "io/reports/acceptance.h"
#include "io/reports/quality_report.h"
#include "limits/limit_report.h"
#include "pipeline/judge.h"

namespace clsurf::cli {

struct CheckedRun {
    Part part;                             ///< with all diagnostics
    std::shared_ptr<const Survey> survey;  ///< of a log that was judged in shards: the surface borrows from it
    ClSurface surface;
    Quality quality;
    LimitReport limits;
    bool states_limits = false;                ///< of a machine file or the budget
    std::optional<io::Acceptance> acceptance;  ///< nothing: no file of accepted defects
    std::vector<BudgetLine> budget;            ///< on passes, then on limits
    ExitCode code = ExitCode::done;

    [[nodiscard]] bool within_budget() const { return quality.report.judgement.judged() && all_held(budget); }
};

/// Reads and judges. `with_motion`: Quality::motion is asked for; `merged`: what was found in shards. Throws as
/// load_part() and rules_of_shards() do.
[[nodiscard]] CheckedRun check_run(const PartOptions& options, std::optional<Role> measured, const CheckBudget& budget,
                                   StageClock& clock, bool with_motion = false,
                                   const std::optional<MergedShards>& merged = std::nullopt);

/// All of a report that comes from the run, which must outlive it.
[[nodiscard]] io::ReportedQuality reported_of(const CheckedRun& run);

/// --tool, --budget, --fail-on, --max-depth, --accepted, and the options of a part: all that says how a run is judged.
void declare_judging(po::options_description& options);

}  // namespace clsurf::cli

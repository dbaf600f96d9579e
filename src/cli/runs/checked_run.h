#pragma once
// CheckedRun: a program and its log, judged as in `check`: passes, limits of the machine, budget.

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
    std::shared_ptr<const Survey> survey;  ///< survey of a log judged in shards: the surface borrows from it
    ClSurface surface;
    Quality quality;
    LimitReport limits;
    bool states_limits = false;                ///< a machine file or the budget states limits
    std::optional<io::Acceptance> acceptance;  ///< nothing: no file of accepted defects
    std::vector<BudgetLine> budget;            ///< lines on passes, then lines on limits
    ExitCode code = ExitCode::done;

    [[nodiscard]] bool within_budget() const { return quality.report.judgement.judged() && all_held(budget); }
};

/// Reads and judges. `with_motion`: compute Quality::motion; `merged`: the findings of shards. Throws as
/// load_part() and rules_of_shards() do.
[[nodiscard]] CheckedRun check_run(const PartOptions& options, std::optional<Role> measured, const CheckBudget& budget,
                                   StageClock& clock, bool with_motion = false,
                                   const std::optional<MergedShards>& merged = std::nullopt);

/// The parts of a report that come from the run, which must outlive it.
[[nodiscard]] io::ReportedQuality reported_of(const CheckedRun& run);

/// --tool, --budget, --fail-on, --max-depth, --accepted, and the options of a part: everything that affects the judgement.
void declare_judging(po::options_description& options);

}  // namespace clsurf::cli

#pragma once
// CheckedRun: a program and a log of it, judged as `check` does it: passes, limits of the machine, budget.

#include <optional>
#include <vector>

#include "cli/part.h"
#include "cli/quality_limits.h"
#include "io/reports/acceptance.h"
#include "limits/limit_report.h"
#include "pipeline/judge.h"

namespace clsurf::cli {

struct CheckedRun {
    Part part;  ///< with all diagnostics
    ClSurface surface;
    Quality quality;
    LimitReport limits;
    bool states_limits = false;                ///< of a machine file or the budget
    std::optional<io::Acceptance> acceptance;  ///< nothing: no file of accepted defects
    std::vector<BudgetLine> budget;            ///< on passes, then on limits
    ExitCode code = ExitCode::done;

    [[nodiscard]] bool within_budget() const { return quality.report.judgement.judged() && all_held(budget); }
};

/// Reads and judges. `with_motion`: Quality::motion is asked for. Throws as load_part() does.
[[nodiscard]] CheckedRun check_run(const PartOptions& options, std::optional<Role> measured, const CheckBudget& budget,
                                   StageClock& clock, bool with_motion = false);

/// --tool, --budget, --fail-on, --max-depth, --accepted, and the options of a part: all that says how a run is judged.
void declare_judging(po::options_description& options);

}  // namespace clsurf::cli

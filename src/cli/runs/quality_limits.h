#pragma once
// --budget, --fail-on, --max-depth: limits for a part.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "io/readers/accepted_file.h"
#include "limits/limit_budget.h"
#include "predictor/verdict.h"

namespace clsurf::cli {

/// Names and numbers (predictor/severity.h).
constexpr const char* severity_words = "trace|visible|distinct|reject|1|2|3|4";

/// The limits for the defects of a part.
struct CheckBudget {
    QualityBudget quality;
    LimitBudget limits;
    std::optional<io::AcceptedFile> accepted;  ///< defects that do not count

    /// Whether the budget has only limits of the machine, none for the passes.
    [[nodiscard]] bool only_limits() const;
};

/// The limits of --budget, overridden by those of the command line, and --accepted. Throws UsageError: a limit factor without
/// --machine.
[[nodiscard]] CheckBudget read_limits(const po::variables_map& values);

/// The limits of a machine, and those of the budget.
[[nodiscard]] std::vector<StatedLimit> stated_limits(std::vector<StatedLimit> limits, const CheckBudget& budget);

/// If the passes were not judged, this result takes precedence over exceeded limits on passes, whose values are then
/// meaningless. `limits` (lines on limits of the machine) always count. A budget of these alone does not need a verdict on
/// passes.
[[nodiscard]] ExitCode code_of(bool judged, const std::vector<BudgetLine>& all, const std::vector<BudgetLine>& limits,
                               const CheckBudget& budget);

}  // namespace clsurf::cli

#pragma once
// --budget, --fail-on, --max-depth: limits that a part must keep.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "io/readers/accepted_file.h"
#include "limits/limit_budget.h"
#include "predictor/verdict.h"

namespace clsurf::cli {

/// By name and by number (predictor/severity.h).
constexpr const char* severity_words = "trace|visible|distinct|reject|1|2|3|4";

/// What a part may have.
struct CheckBudget {
    QualityBudget quality;
    LimitBudget limits;
    std::optional<io::AcceptedFile> accepted;  ///< defects that do not count

    /// Nothing is said of the passes, only of limits of the machine.
    [[nodiscard]] bool only_limits() const;
};

/// The limits of --budget, those of the command line, which come first, and --accepted. Throws UsageError: a limit factor without
/// --machine.
[[nodiscard]] CheckBudget read_limits(const po::variables_map& values);

/// Limits of a machine, and of the budget.
[[nodiscard]] std::vector<StatedLimit> stated_limits(std::vector<StatedLimit> limits, const CheckBudget& budget);

/// No verdict on the passes comes before a failed one: numbers that mean nothing meet no budget and miss none. `limits`, lines
/// on limits of the machine, count whether the passes are judged or not. A budget of these alone asks nothing of the passes.
[[nodiscard]] ExitCode code_of(bool judged, const std::vector<BudgetLine>& all, const std::vector<BudgetLine>& limits,
                               const CheckBudget& budget);

}  // namespace clsurf::cli

#include "cli/runs/quality_limits.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "io/readers/budget_file.h"
#include "predictor/severity.h"

namespace clsurf::cli {
namespace {

int severity_of(const std::string& word) {
    int severity = 1;
    while (severity < severities && word != name_of_severity(severity) && word != std::to_string(severity)) ++severity;
    return severity;
}

}  // namespace

bool CheckBudget::only_limits() const {
    const auto rows = budget_limits();
    return (limits.max_limit_factor || limits.max_following_error_um) &&
           std::none_of(rows.begin(), rows.end(),
                        [&](const QualityLimit& row) { return (quality.*row.limit).has_value(); });
}

CheckBudget read_limits(const po::variables_map& values) {
    CheckBudget budget;
    if (values.count("budget") > 0) {
        const std::string path = values["budget"].as<std::string>();
        budget.quality = io::read_budget(path);
        budget.limits = io::read_limit_budget(path);
        if (budget.limits.max_limit_factor && values.count("machine") == 0)
            throw UsageError("max_limit_factor in " + path + " needs the limits of the machine", "--machine FILE");
    }
    if (values.count("fail-on") > 0)
        budget.quality.max_severity =
            severity_of(values["fail-on"].as<std::string>()) - 1.0;  // lower severities do not fail
    if (values.count("max-depth") > 0)
        budget.quality.max_depth_um = um_per_mm * parse_length(values["max-depth"].as<std::string>(), "--max-depth");
    if (values.count("accepted") > 0) budget.accepted = io::read_accepted(values["accepted"].as<std::string>());
    return budget;
}

std::vector<StatedLimit> stated_limits(std::vector<StatedLimit> limits, const CheckBudget& budget) {
    for (const StatedLimit& limit : following_error_limits(budget.limits)) limits.push_back(limit);
    return limits;
}

ExitCode code_of(bool judged, const std::vector<BudgetLine>& all, const std::vector<BudgetLine>& limits,
                 const CheckBudget& budget) {
    if (!all_held(limits)) return ExitCode::check_failed;
    if (budget.only_limits()) return ExitCode::done;
    if (!judged) return ExitCode::not_judged;
    return all_held(all) ? ExitCode::done : ExitCode::check_failed;
}

}  // namespace clsurf::cli

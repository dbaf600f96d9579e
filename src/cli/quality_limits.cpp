#include "cli/quality_limits.h"

#include <string>

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

QualityBudget read_limits(const po::variables_map& values) {
    QualityBudget budget;
    if (values.count("budget") > 0) budget = io::read_budget(values["budget"].as<std::string>());
    if (values.count("fail-on") > 0)
        budget.max_severity = severity_of(values["fail-on"].as<std::string>()) - 1.0;  // those below do not fail
    if (values.count("max-depth") > 0)
        budget.max_depth_um = um_per_mm * parse_length(values["max-depth"].as<std::string>(), "--max-depth");
    return budget;
}

}  // namespace clsurf::cli

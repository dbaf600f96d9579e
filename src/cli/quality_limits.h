#pragma once
// --budget, --fail-on, --max-depth: limits that a part must keep.

#include "cli/options.h"
#include "predictor/verdict.h"

namespace clsurf::cli {

/// By name and by number (predictor/severity.h).
constexpr const char* severity_words = "trace|visible|distinct|reject|1|2|3|4";

/// The limits of --budget, and those of the command line, which come first.
[[nodiscard]] QualityBudget read_limits(const po::variables_map& values);

}  // namespace clsurf::cli

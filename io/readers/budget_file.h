#pragma once
// A budget as a TOML file: `max_depth_um = 5` and the other names of docs/predictor.md; for differences
// between runs, the names of docs/diff.md.

#include <string>

#include "compare/run_budget.h"
#include "limits/limit_budget.h"
#include "predictor/verdict.h"

namespace clsurf::io {

/// Throws InputError: unreadable, an unknown key, a value that is not a number ≥ 0.
[[nodiscard]] QualityBudget read_budget(const std::string& path);
/// The limits of the machine in the same file.
[[nodiscard]] LimitBudget read_limit_budget(const std::string& path);
[[nodiscard]] RunBudget read_run_budget(const std::string& path);

}  // namespace clsurf::io

#pragma once
// The options of `diff`.

#include <string>
#include <vector>

#include "cli/options/look.h"
#include "cli/runs/runs.h"
#include "compare/run_budget.h"
#include "compare/run_difference.h"

namespace clsurf::cli {

struct DiffOptions {
    std::vector<std::string> files;  ///< the reference first
    RunOptions runs;
    RunBudget budget;
    std::string output;  ///< file of the map; empty: none
    RunQuantity shown = RunQuantity::speed;
    LookOptions look;
    bool json = false;
};

void declare_diff(po::options_description& options);
/// Throws UsageError, InputError.
[[nodiscard]] DiffOptions read_diff_options(const po::variables_map& values);

}  // namespace clsurf::cli

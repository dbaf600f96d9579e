#pragma once
// `simulate --tradeoff`: a program with many settings of its machine, and a choice from them by a weight.

#include "cli/programs/front_output.h"

namespace clsurf::cli {

/// --tradeoff, --weight, --settings, --more-time, --runs.
void declare_settings_tradeoff(po::options_description& options);

/// Throws UsageError, InputError, SystemError.
ExitCode trade_off_settings(const po::variables_map& values);

/// Throws UsageError if an option of the search is given without --tradeoff or --weight.
void refuse_settings_options(const po::variables_map& values);

}  // namespace clsurf::cli

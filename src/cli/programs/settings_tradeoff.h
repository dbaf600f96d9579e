#pragma once
// `simulate --tradeoff`: a program at many settings of its machine, and the choice from them by a weight.

#include "cli/programs/front_output.h"

namespace clsurf::cli {

/// --tradeoff, --weight, --settings, --more-time, --runs.
void declare_settings_tradeoff(po::options_description& options);

/// Throws UsageError, InputError, SystemError.
ExitCode trade_off_settings(const po::variables_map& values);

/// Throws UsageError where an option of the search is given without it.
void refuse_settings_options(const po::variables_map& values);

}  // namespace clsurf::cli

#pragma once
// `plot --profile`: a profile across the as-machined surface with its roughness.

#include <string>

#include "cli/options/part.h"
#include "viz/chart.h"

namespace clsurf::cli {

/// --profile, --tool.
void declare_profile(po::options_description& options);
/// Throws UsageError if options of profiles and of curves are mixed.
[[nodiscard]] bool asks_for_profile(const po::variables_map& values);
[[nodiscard]] ExitCode plot_profile(const po::variables_map& values, PartOptions options, viz::ChartLook look,
                                    const std::string& output_name);

}  // namespace clsurf::cli

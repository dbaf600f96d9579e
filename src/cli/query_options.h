#pragma once
// What `query` is asked for, by its options.

#include <vector>

#include "cli/options.h"
#include "pipeline/point_query.h"

namespace clsurf::cli {

void declare_query(po::options_description& options);

/// What --point, --at, --time and --line find, in this order. Throws UsageError: none of them is given, or a value is not
/// one of this part. Adds `query.off-the-part`.
[[nodiscard]] std::vector<QueryMatch> find_matches(const Part& part, const po::variables_map& values,
                                                   Diagnostics& diagnostics);

}  // namespace clsurf::cli

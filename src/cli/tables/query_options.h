#pragma once
// The queries of `query`, from its options.

#include <optional>
#include <vector>

#include "cli/options/options.h"
#include "pipeline/point_query.h"

namespace clsurf::cli {

void declare_query(po::options_description& options);

struct QueryAnswer {
    std::vector<QueryMatch> matches;
    /// The line if the numbers of --at are a tool tip read off a map instead of a place on the part; nothing if it is the
    /// same line.
    std::optional<LineNumber> tip_line;
};

/// The results of --point, --at, --time and --line, in this order. Throws UsageError: none of them is given, or a value is
/// not in this part. Adds `query.off-the-part`.
[[nodiscard]] QueryAnswer find_matches(const Part& part, const po::variables_map& values, Diagnostics& diagnostics);

}  // namespace clsurf::cli

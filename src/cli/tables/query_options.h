#pragma once
// What `query` is asked for, by its options.

#include <optional>
#include <vector>

#include "cli/options/options.h"
#include "pipeline/point_query.h"

namespace clsurf::cli {

void declare_query(po::options_description& options);

struct QueryAnswer {
    std::vector<QueryMatch> matches;
    /// The line in which the tool tip was at the numbers of --at, where they are a place on the part, may have been read off a map,
    /// and that line is another one.
    std::optional<LineNumber> tip_line;
};

/// What --point, --at, --time and --line find, in this order. Throws UsageError: none of them is given, or a value is not
/// one of this part. Adds `query.off-the-part`.
[[nodiscard]] QueryAnswer find_matches(const Part& part, const po::variables_map& values, Diagnostics& diagnostics);

}  // namespace clsurf::cli

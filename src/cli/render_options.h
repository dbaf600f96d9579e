#pragma once
// The options of `render`.

#include <optional>
#include <string>
#include <vector>

#include "cli/look.h"
#include "cli/part.h"

namespace clsurf::cli {

struct RenderOptions {
    PartOptions part;
    std::string before;  ///< log of the other panel; empty: one panel
    std::string output;
    bool defect_map = false;  ///< of `defects`: sections and names on a grey relief, not outlines on a field
    std::string field;        ///< empty: feed_share, or speed where no feed is known
    LookOptions shown;
    std::vector<PointIndex> points;
    std::vector<LineNumber> lines;
    bool defects = false;
    std::optional<Role> swept;  ///< its positions; none: the most truthful
};

void declare_render(po::options_description& options);
/// Throws UsageError.
[[nodiscard]] RenderOptions read_render_options(const po::variables_map& values);

}  // namespace clsurf::cli

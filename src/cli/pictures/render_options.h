#pragma once
// The options of `render`.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/look.h"
#include "cli/options/part.h"

namespace clsurf::cli {

/// Numbers from `first` to `last`; a missing end is open.
struct NumberRange {
    std::int64_t first = 0;
    std::int64_t last = std::numeric_limits<std::int64_t>::max();
};

/// The shown part of a run: the intersection of all ranges.
struct Selection {
    std::optional<NumberRange> points, lines, passes;
    [[nodiscard]] bool is_all() const { return !points && !lines && !passes; }
    std::string words;  ///< "points 100..300, passes 2..5"
};

struct RenderOptions {
    PartOptions part;  ///< without a log, the program is simulated or shown as programmed
    Selection selection;
    std::string before;  ///< log of the other panel; empty: one panel
    std::string output;
    bool defect_map = false;  ///< sections and names on a grey surface, instead of outlines on a field
    std::string field;        ///< empty: feed_share, or speed if no feed is known
    LookOptions shown;
    std::vector<PointIndex> points;
    std::vector<LineNumber> lines;
    bool defects = false;
    bool programmed = false;    ///< also draw the path of the program
    std::optional<Role> swept;  ///< the swept positions; none: the most truthful
};

void declare_render(po::options_description& options);
/// Throws UsageError.
[[nodiscard]] RenderOptions read_render_options(const po::variables_map& values);

}  // namespace clsurf::cli

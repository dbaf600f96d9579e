#pragma once
// Placeholder: a position in a log where none was recorded. The path jumps to it, always exactly the same, and
// returns to where it was.

#include <array>
#include <optional>

#include "core/channel_view.h"
#include "core/point.h"

namespace clsurf {

struct Placeholder {
    std::array<double, 3> position{};  ///< x, y, z as they stand in the log [mm]
    PointIndex first = 0;              ///< record at which it comes first
    PointIndex times = 0;              ///< how often the path jumps to it, three times or more
    double farthest = 0;               ///< the longest of these jumps [mm]
};

/// The most frequent one, of jumps over more than 10 mm and in two axes or more that return within 256 records. `axes`: x, y,
/// z of one role, of the same size. O(records), parallel.
[[nodiscard]] std::optional<Placeholder> find_placeholder(const std::array<ChannelView, 3>& axes);

}  // namespace clsurf

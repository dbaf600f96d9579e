#pragma once
// Placeholder: a position in a log that substitutes for one that was not recorded. The path jumps to exactly
// this position each time and returns to where it was.

#include <array>
#include <optional>

#include "core/channel_view.h"
#include "core/point.h"

namespace clsurf {

struct Placeholder {
    std::array<double, 3> position{};  ///< x, y, z as in the log [mm]
    PointIndex first = 0;              ///< the first record with it
    PointIndex times = 0;              ///< number of jumps of the path to it, at least three
    double farthest = 0;               ///< the longest of these jumps [mm]
};

/// The most frequent placeholder, among jumps over more than 10 mm and in at least two axes that return within 256 records.
/// `axes`: x, y, z of one role, of the same size. O(records), parallel.
[[nodiscard]] std::optional<Placeholder> find_placeholder(const std::array<ChannelView, 3>& axes);

}  // namespace clsurf

#pragma once
// Ranges of points, such as passes, pieces and runs, in the order of their first points. A range is anything with a first point
// and a last one, inclusive.

#include <algorithm>
#include <iterator>

#include "core/point.h"

namespace clsurf {

/// The last range that begins at a point or before it; the first range if all begin after it. O(log ranges).
template <typename Ranges>
[[nodiscard]] auto range_at(const Ranges& ranges, PointIndex point) {
    const auto behind = std::upper_bound(ranges.begin(), ranges.end(), point,
                                         [](PointIndex i, const auto& range) { return i < range.first; });
    return behind == ranges.begin() ? behind : std::prev(behind);
}

/// Whether one of the ranges contains a point. They do not overlap. O(log ranges).
template <typename Ranges>
[[nodiscard]] bool any_has(const Ranges& ranges, PointIndex point) {
    const auto range = range_at(ranges, point);
    return range != ranges.end() && range->first <= point && point <= range->last;
}

}  // namespace clsurf

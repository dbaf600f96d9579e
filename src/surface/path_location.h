#pragma once
// PathLocation: a place on the path between two logged points; and the intersection of an adjacent pass with the plane
// normal to the feed at a location. A comparison with the nearest logged point instead would compare places up to half a
// period apart along the feed: while braking at 600 mm/s², this alone is a speed difference of 0.3 mm/s.

#include <cmath>
#include <concepts>
#include <ranges>
#include <type_traits>
#include <utility>

#include "surface/cl_surface.h"

namespace clsurf {

struct PathLocation {
    PointIndex point = -1;  ///< −1: none
    float fraction = 0;     ///< of the step from point to point + 1, 0 … 1

    [[nodiscard]] bool exists() const { return point >= 0; }
    [[nodiscard]] PointIndex nearest() const { return fraction < 0.5F ? point : point + 1; }
};

/// The value at a location, linear between the points. `value_of`: number or vector of a point. Domain: exists().
template <std::invocable<PointIndex> ValueOf>
[[nodiscard]] auto interpolate(ValueOf&& value_of, const PathLocation& at) {
    using Value = std::decay_t<std::invoke_result_t<ValueOf, PointIndex>>;
    const Value here = value_of(at.point);
    if (at.fraction == 0) return here;
    const Value next = value_of(at.point + 1);
    if constexpr (std::is_arithmetic_v<Value>)
        return here + at.fraction * (next - here);
    else
        return Value(here + static_cast<typename Value::Scalar>(at.fraction) * (next - here));
}

/// The same of values in the order of the points.
template <std::ranges::random_access_range Values>
[[nodiscard]] auto interpolate(const Values& values, const PathLocation& at) {
    return interpolate([&](PointIndex i) { return values[static_cast<std::size_t>(i)]; }, at);
}

[[nodiscard]] inline Eigen::Vector3f position_at(const Positions& p, const PathLocation& at) {
    return {interpolate(p.x, at), interpolate(p.y, at), interpolate(p.z, at)};
}

/// The intersection of the pass on that side with the plane through `from`, normal to `feed` (any length); none if
/// there is no neighbour. O(1): the adjacency has the point next to it.
[[nodiscard]] PathLocation adjacent_location(const ClSurface& surface, const PathLocation& from,
                                             const Eigen::Vector3f& feed, Side side);

/// The same on the side away from `before`, the location on the previous pass: sides are relative to the feed, which
/// is reversed on every other pass of a zigzag.
[[nodiscard]] PathLocation beyond(const ClSurface& surface, const PathLocation& before, const PathLocation& from,
                                  const Eigen::Vector3f& feed);

/// Calls f(at, before) for the places on the passes on one side of `from`, the adjacent pass first, as long as f returns
/// true. `before`: the place on the previous pass. `feed`(place): the direction of travel there. Returns the place on the
/// adjacent pass.
template <typename FeedAt, typename F>
PathLocation walk_aside(const ClSurface& surface, const PathLocation& from, Side side, FeedAt&& feed, F&& f) {
    PathLocation before = from;
    const PathLocation adjacent = adjacent_location(surface, from, feed(from), side);
    PathLocation at = adjacent;
    while (at.exists() && f(at, before)) {
        const PathLocation next = beyond(surface, before, at, feed(at));
        before = std::exchange(at, next);
    }
    return adjacent;
}

}  // namespace clsurf

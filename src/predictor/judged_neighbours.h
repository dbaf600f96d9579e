#pragma once
// The passes next to a place that can be compared with it.

#include <cmath>

#include "predictor/signals.h"
#include "surface/path_location.h"

namespace clsurf {

inline constexpr float along_or_against = 0.866F;  ///< cos 30°: feeds of neighbours are parallel or opposite

/// Calls f(place, number of passes away, from 1) for at most `aside` passes on one side of a place, the adjacent one first.
/// Stops at a pass that is not judged, or whose direction differs from that of the pass before by the angle of `least_cosine`
/// or more. Returns the place on the adjacent pass, judged or not.
template <typename F>
PathLocation for_each_judged_neighbour(const ClSurface& surface, const Signals& signals, const PathLocation& from,
                                       Side side, int aside, float least_cosine, F&& f) {
    int passes = 0;
    const auto feed = [&](const PathLocation& at) { return signals.feed(at.nearest()); };
    return walk_aside(surface, from, side, feed, [&](const PathLocation& at, const PathLocation& before) {
        const bool runs_along = std::abs(feed(at).dot(feed(before))) > least_cosine;
        if (signals[at.nearest()].zone == Zone::outside || !runs_along) return false;
        f(at, ++passes);
        return passes < aside;
    });
}

}  // namespace clsurf

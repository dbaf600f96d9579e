#include "mapping/path_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clsurf {
namespace {

// Lengths in mm.
constexpr double window_margin = 0.05;       ///< length that the window always has
constexpr double window_of_chord = 2.0;      ///< length per chord: corners are cut, the chord is shorter
constexpr double window_of_distance = 10.0;  ///< length per distance: a projection jumps over a cut corner
constexpr double arc_length_penalty = 0.02;  ///< mm of distance per mm that arc length and chord differ

}  // namespace

PathWalk::PathWalk(const Toolpath& path) : path_(path) {
    const auto n = static_cast<std::size_t>(path.size());
    length_.resize(n);
    for (std::size_t i = 0; i < n; ++i) length_[i] = path.length(static_cast<std::int64_t>(i));
}

WalkState PathWalk::advance(const WalkState& from, const Vec3& p, double chord, std::int64_t last) const {
    WalkState best = from;
    double best_cost = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    double gone = -from.fraction * length(from.motion);  // to the start of motion m
    for (std::int64_t m = from.motion; m <= last; ++m) {
        const bool moves = length(m) > 0;
        if (moves || m == from.motion) {
            const Projection projection = path_.projection(m, p, m == from.motion ? from.fraction : 0.0);
            const double advance = gone + projection.fraction * length(m);
            const double cost = projection.distance + arc_length_penalty * std::abs(advance - chord);
            nearest = std::min(nearest, projection.distance);
            if (cost < best_cost) {
                best_cost = cost;
                best = {m, projection.fraction, projection.distance};
            }
        }
        gone += length(m);
        // Farther than lost the walk finds nothing: a whole program would be searched for each point.
        if (gone > window_margin + window_of_chord * chord + window_of_distance * std::min(nearest, lost_distance))
            break;
    }
    return best;
}

}  // namespace clsurf

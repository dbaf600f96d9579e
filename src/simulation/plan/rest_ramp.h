#pragma once
// RestRamp: the motion from or to a rest at constant jerk, where v² is not a quadratic of the arc length.

#include "machine/machine.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

/// Motion from rest at constant jerk. A jerk of 0: there is no ramp.
struct RestRamp {
    double jerk = 0, time = 0;           ///< [mm/s³, s]
    double speed = 0, acceleration = 0;  ///< at its end
};

/// As steepest_from_rest(), with the limits of one span of the distance.
[[nodiscard]] RestRamp steepest_on(const Span& span, double distance, const Machine& machine);

/// The ramp from rest at the greatest jerk whose end stays below every limit. With constant jerk j over a distance s, v a =
/// 3 j s and v³ = 4.5 j s², so the jerk of an axis, x′ j + 3 x″ v a + x‴ v³, is proportional to j. `from_rest`: the spans
/// in the order in which the motion leaves the rest; backward for a motion to the rest. O(spans on the distance).
template <typename Iterator>
[[nodiscard]] RestRamp steepest_from_rest(double distance, Iterator from_rest, Iterator end, const Machine& machine) {
    RestRamp lowest;
    for (double begin = 0; begin < distance; ++from_rest) {
        if (from_rest == end) return {};
        const RestRamp ramp = steepest_on(*from_rest, distance, machine);
        if (!(ramp.jerk > 0)) return {};
        if (!(lowest.jerk > 0) || ramp.jerk < lowest.jerk) lowest = ramp;
        begin += from_rest->length;
    }
    return lowest;
}

}  // namespace clsurf

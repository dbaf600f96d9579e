#pragma once
// RestRamp: the motion from or to a rest at one jerk, where v² over arc length is no quadratic.

#include "machine/machine.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

/// From rest at constant jerk. A jerk of 0: there is none.
struct RestRamp {
    double jerk = 0, time = 0;           ///< [mm/s³, s]
    double speed = 0, acceleration = 0;  ///< at its end
};

/// The same as steepest_from_rest(), as far as one span of the way holds it back.
[[nodiscard]] RestRamp steepest_on(const Span& span, double distance, const Machine& machine);

/// From rest at the greatest jerk, if that ends below every limit. With constant jerk j over a distance s, v a = 3 j s and
/// v³ = 4.5 j s²: the jerk of an axis, x′ j + 3 x″ v a + x‴ v³, grows with j alone. `from_rest`: spans in the order in which
/// they are left, or backward, in which they lead to the rest. O(spans on the distance).
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

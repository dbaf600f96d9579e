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

/// From rest at the greatest jerk, if that ends below every limit. With constant jerk j over a distance s, v a = 3 j s and
/// v³ = 4.5 j s²: the jerk of an axis, x′ j + 3 x″ v a + x‴ v³, grows with j alone.
[[nodiscard]] RestRamp steepest_from_rest(double distance, const Span& span, const Machine& machine);

}  // namespace clsurf

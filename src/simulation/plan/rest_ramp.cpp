#include "simulation/plan/rest_ramp.h"

#include <algorithm>
#include <cmath>

namespace clsurf {

RestRamp steepest_from_rest(double way, const Span& span, const Machine& machine) {
    if (way > span.length) return {};
    const auto most = [way](double limit, double slope, double bend, double twist) {
        return limit / (slope + 9 * bend * way + 4.5 * twist * way * way);
    };
    double jerk = span.jerk;
    if (!span.straight()) {
        jerk = std::min(jerk, most(machine.path.max_jerk, span.greatest_slope, span.pace_slope, span.pace_curve));
        for (int i = 0; i < 3; ++i) {
            const double limit = machine.axes[static_cast<std::size_t>(i)].max_jerk;
            if (limit > 0) jerk = std::min(jerk, most(limit, span.slope[i], span.bend[i], span.twist[i]));
        }
    }
    const double time = std::cbrt(6 * way / jerk);
    const RestRamp ramp{jerk, time, 0.5 * jerk * time * time, jerk * time};
    const double square = ramp.speed * ramp.speed;
    bool held = ramp.speed <= (span.straight() ? span.free_cap : std::min(span.free_cap, span.cap)) &&
                ramp.acceleration <= std::min(span.acceleration, machine.path.max_acceleration);
    if (span.straight()) return held ? ramp : RestRamp{};
    held = held && span.greatest_slope * ramp.acceleration + span.pace_slope * square <= machine.path.max_acceleration;
    for (int i = 0; i < 3; ++i) {
        const double acceleration = span.slope[i] * ramp.acceleration + span.bend[i] * square;
        held = held && acceleration <= machine.axes[static_cast<std::size_t>(i)].max_acceleration;
    }
    return held ? ramp : RestRamp{};
}

}  // namespace clsurf

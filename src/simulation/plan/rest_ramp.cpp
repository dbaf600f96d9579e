#include "simulation/plan/rest_ramp.h"

#include <algorithm>
#include <cmath>

namespace clsurf {

RestRamp steepest_on(const Span& span, double distance, const Machine& machine) {
    const auto most = [distance](double limit, double first, double second, double third) {
        return limit / (first + 9 * second * distance + 4.5 * third * distance * distance);
    };
    double jerk = span.jerk;
    if (!span.straight()) {
        jerk = std::min(jerk, most(machine.path.max_jerk, span.greatest_first, span.pace_slope, span.pace_curve));
        for (int i = 0; i < 3; ++i) {
            const double limit = machine.axes[static_cast<std::size_t>(i)].max_jerk;
            if (limit > 0) jerk = std::min(jerk, most(limit, span.first[i], span.second[i], span.third[i]));
        }
    }
    const double time = std::cbrt(6 * distance / jerk);
    const RestRamp ramp{jerk, time, 0.5 * jerk * time * time, jerk * time};
    const double square = ramp.speed * ramp.speed;
    bool held = ramp.speed <= (span.straight() ? span.free_cap : std::min(span.free_cap, span.cap)) &&
                ramp.acceleration <= std::min(span.acceleration, machine.path.max_acceleration);
    if (span.straight()) return held ? ramp : RestRamp{};
    held = held && span.greatest_first * ramp.acceleration + span.pace_slope * square <= machine.path.max_acceleration;
    for (int i = 0; i < 3; ++i) {
        const double acceleration = span.first[i] * ramp.acceleration + span.second[i] * square;
        held = held && acceleration <= machine.axes[static_cast<std::size_t>(i)].max_acceleration;
    }
    return held ? ramp : RestRamp{};
}

}  // namespace clsurf

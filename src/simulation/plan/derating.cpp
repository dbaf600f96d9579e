#include "simulation/plan/derating.h"

#include <algorithm>
#include <array>

namespace clsurf {
namespace {

constexpr double share_of_bend = 0.5;  ///< share of the axis jerk left on a bend, for tangential acceleration there
// Shares of the tangential limits: large for long ramps on bends, small where speeds are nearly constant.
struct LeastLeft {
    double acceleration, jerk;
};
constexpr std::array<LeastLeft, deratings> least_left{{{0.5, 0.5}, {0.2, 0.3}, {0.1, 0.15}}};

/// The tangential limits that remain at a speed. On a bend an acceleration causes jerk, too, 3 y″ v a, in addition to the
/// tangential jerk: the remaining axis jerk is divided between them.
Derating left_at(double speed, const Span& span, const Machine& machine) {
    Derating left{speed, span.acceleration, span.jerk};
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine.axes[static_cast<std::size_t>(i)];
        if (span.first[i] > 0)
            left.acceleration =
                std::min(left.acceleration, (axis.max_acceleration - span.second[i] * speed * speed) / span.first[i]);
        if (axis.max_jerk <= 0 || span.second[i] <= 0) continue;
        const double room = axis.max_jerk - span.third[i] * speed * speed * speed;
        left.acceleration = std::min(left.acceleration, share_of_bend * room / (3 * span.second[i] * speed));
    }
    const double path_room = machine.path.max_jerk - span.pace_curve * speed * speed * speed;
    if (span.rounded)
        left.acceleration = std::min(
            left.acceleration, (machine.path.max_acceleration - span.pace_slope * speed * speed) / span.greatest_first);
    if (span.pace_slope > 0)
        left.acceleration = std::min(left.acceleration, share_of_bend * path_room / (3 * span.pace_slope * speed));
    left.acceleration = std::max(left.acceleration, 0.0);
    if (span.rounded)
        left.jerk =
            std::min(left.jerk, (path_room - 3 * span.pace_slope * speed * left.acceleration) / span.greatest_first);
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine.axes[static_cast<std::size_t>(i)];
        if (axis.max_jerk <= 0 || span.first[i] <= 0) continue;
        const double room = axis.max_jerk - span.third[i] * speed * speed * speed;
        left.jerk = std::min(left.jerk, (room - 3 * span.second[i] * speed * left.acceleration) / span.first[i]);
    }
    return left;
}

}  // namespace

Derating derate(const Span& span, const Machine& machine, std::size_t which) {
    const LeastLeft& least = least_left[which];
    const auto enough = [&](const Derating& left) {
        return left.acceleration >= least.acceleration * span.acceleration && left.jerk >= least.jerk * span.jerk;
    };
    const Derating at_cap = left_at(span.cap, span, machine);
    if (enough(at_cap)) return at_cap;
    double low = 0;
    double high = span.cap;
    constexpr int halvings = 40;
    for (int k = 0; k < halvings && high - low > 1e-3 * high; ++k) {
        const double middle = 0.5 * (low + high);
        (enough(left_at(middle, span, machine)) ? low : high) = middle;
    }
    return left_at(low, span, machine);
}

}  // namespace clsurf

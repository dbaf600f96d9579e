#include "simulation/plan/held_place.h"

#include <algorithm>
#include <cmath>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

BendSpeed bend_speed(const PathDerivatives& d, const Pace& pace, const Machine& machine) {
    const double across = std::sqrt(std::max(0.0, d.second.squaredNorm() - pace.slope * pace.slope));
    if (!(across > 0)) return {};
    const double by_acceleration = std::sqrt(machine.path.max_normal_acceleration / across);
    if (!(pace.value > 0)) return {by_acceleration};
    const double radius = pace.value * pace.value / across;
    BendSpeed bend{by_acceleration};
    const auto limit = [&](double path_speed, LimitingFactor why) {
        if (path_speed < bend.speed * pace.value) bend = {path_speed / pace.value, why};
    };
    limit(chord_speed(radius, machine.controller.chord_tolerance, machine.controller.period),
          LimitingFactor::chord_error);
    if (limits_jerk_in_bends(machine)) limit(jerk_speed(radius, machine.path.max_jerk), LimitingFactor::jerk);
    return bend;
}

}  // namespace

HeldPlace held_place(const CellPart& part, double arc_length, const Machine& machine) {
    const PathDerivatives d = part.span->derivatives(part.from + arc_length);
    const Pace pace = pace_of(d);
    HeldPlace place;
    place.bend = bend_speed(d, pace, machine);
    place.sample.at = arc_length;
    place.sample.first = d.first;
    place.sample.second = d.second;
    place.sample.third = d.third;
    if (part.span->rounded) place.sample.pace = pace;  // if not rounded, the cell's limits are complete
    place.sample.cap = place.bend.speed;
    return place;
}

}  // namespace clsurf

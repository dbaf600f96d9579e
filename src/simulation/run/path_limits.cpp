#include "simulation/run/path_limits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "machine/limit_table.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

/// Arcs in corners are for drives that tolerate steps of the curvature. Where an arc meets the rounding of another corner,
/// the tangential acceleration also steps.
bool limits_tangential_jerk(const Machine& machine) {
    const bool arcs = drives_arcs(machine) && only_path_jerk(machine);
    return machine.controller.planner == PlannerKind::time_optimal && !arcs;
}

bool limits_normal_acceleration(const Machine& machine) {
    return machine.controller.planner == PlannerKind::time_optimal && machine.controller.corner != CornerMode::junction;
}

}  // namespace

void NormalAcceleration::measure() {
    const Vec3 bend = out_ - in_, chord = in_ + out_;
    const double length = chord.norm(), before = in_.norm(), after = out_.norm();
    if (!(length > 0 && before > 0 && after > 0)) return;  // from or to a rest, or a full reversal: no direction
    const Vec3 direction = chord / length;
    const double across = (bend - bend.dot(direction) * direction).norm() * rate_ * rate_;
    const double half_turn = 0.5 * (in_ / before - out_ / after).norm();  // sine of half the turn
    const double along = *std::max_element(changes_.begin(), changes_.end()) * rate_;
    const double lower_bound = across - along * half_turn;
    if (!(lower_bound > greatest_)) return;
    greatest_ = lower_bound;
    least_bend_ = lower_bound * lower_bound / (rate_ * rate_ * rate_ * rate_);
}

LimitExcessOfPath excess_of_path(const SimulationSummary& s, const Machine& machine) {
    LimitExcessOfPath excess;
    const auto judge = [&](double value, double limit, const char* what) {
        if (limit <= 0 || value <= excess.factor * limit) return;
        excess = {value / limit, what};
    };
    const PathLimits& limits = machine.path;
    judge(s.max_speed, limits.max_speed, "speed of the path");
    judge(s.max_tangential_acceleration, limits.max_acceleration, "tangential acceleration of the path");
    if (limits_normal_acceleration(machine))
        judge(s.max_normal_acceleration, limits.max_normal_acceleration, "normal acceleration of the path");
    if (limits_tangential_jerk(machine)) judge(s.max_tangential_jerk, limits.max_jerk, "tangential jerk of the path");
    return excess;
}

}  // namespace clsurf

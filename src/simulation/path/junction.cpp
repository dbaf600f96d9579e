#include "simulation/path/junction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clsurf {

double deflection(const Vec3& in, const Vec3& out) { return 2 * std::atan2((in - out).norm(), (in + out).norm()); }

double chord_speed(double radius, double error, double period) {
    if (radius <= error) return 2 * radius / period;
    return 2 / period * std::sqrt(error * (2 * radius - error));
}

double arc_speed(double radius, double normal_acceleration) { return std::sqrt(normal_acceleration * radius); }

double jerk_speed(double radius, double jerk) { return std::cbrt(jerk * radius * radius); }

bool only_path_jerk(const Machine& machine) {
    return std::none_of(machine.axes.begin(), machine.axes.end(),
                        [](const MachineAxis& axis) { return axis.max_jerk > 0; });
}

bool drives_arcs(const Machine& machine) {
    return machine.controller.corner == CornerMode::arc &&
           (only_path_jerk(machine) || machine.controller.arc_step_time > 0);
}

bool limits_jerk_in_bends(const Machine& machine) {
    return only_path_jerk(machine) && machine.controller.corner != CornerMode::arc;
}

bool jerks_freely(const Machine& machine) {
    return only_path_jerk(machine) &&
           machine.path.max_jerk * machine.controller.period >= 2 * machine.path.max_acceleration;
}

double period_speed(double radius, double turning, double period) {
    return 2 * radius * std::sin(0.5 * turning) / period;
}

double junction_speed(const Vec3& turn, const Machine& machine) {
    const JunctionSettings& rules = machine.controller.junction;
    double speed = std::numeric_limits<double>::infinity();
    const double length = turn.norm();
    if (!(length > 0)) return speed;
    const double greatest = turn.cwiseAbs().maxCoeff();
    if (rules.speed_step > 0) speed = rules.speed_step / greatest;
    if (rules.deviation > 0) {
        const double sine = std::min(1.0, 0.5 * length), cosine = std::sqrt(1 - sine * sine);  // of half the deflection
        // 1 − cos = sin²/(1 + cos), without cancellation.
        const double radius = rules.deviation * cosine * (1 + cosine) / (sine * sine);
        double acceleration = machine.path.max_normal_acceleration;
        for (int i = 0; i < 3; ++i) {
            if (turn[i] != 0)
                acceleration = std::min(acceleration, machine.axes[static_cast<std::size_t>(i)].max_acceleration *
                                                          length / std::abs(turn[i]));
        }
        speed = std::min(speed, arc_speed(radius, acceleration));
    }
    return speed;
}

}  // namespace clsurf

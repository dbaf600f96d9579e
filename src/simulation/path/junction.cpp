#include "simulation/path/junction.h"

#include <cmath>

namespace clsurf {

double deflection(const Vec3& in, const Vec3& out) { return 2 * std::atan2((in - out).norm(), (in + out).norm()); }

double chord_speed(double radius, double error, double period) {
    if (radius <= error) return 2 * radius / period;
    return 2 / period * std::sqrt(error * (2 * radius - error));
}

double arc_speed(double radius, double normal_acceleration) { return std::sqrt(normal_acceleration * radius); }

double period_speed(double radius, double turning, double period) {
    return 2 * radius * std::sin(0.5 * turning) / period;
}

}  // namespace clsurf

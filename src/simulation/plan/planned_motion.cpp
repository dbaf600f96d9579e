#include "simulation/plan/planned_motion.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

// The next term is x²/3, 3·10^-13 of the first.
constexpr double least_angle = 1e-6;  ///< [rad] for smaller angles the first term of the series is exact

}  // namespace

// u″ = acceleration + curve u is linear: with ω² = |curve|, u is a hyperbolic or circular function of ω t, and tanh(ω t/2)
// or tan(ω t/2) = ω length/(v0 + v1).
double CellMotion::duration() const {
    const double end = std::sqrt(std::max(0.0, speed * speed + length * (2 * acceleration + curve * length)));
    const double half = length / (speed + end);
    const double omega = std::sqrt(std::abs(curve));
    const double x = omega * half;
    if (x < least_angle) return 2 * half;
    return 2 / omega * (curve > 0 ? std::atanh(x) : std::atan(x));
}

double CellMotion::arc_length_at(double time, double& v) const {
    if (curve == 0) {  // as on a machine without a jerk limit
        v = speed + time * acceleration;
        return speed * time + acceleration * (0.5 * time * time);
    }
    const double omega = std::sqrt(std::abs(curve));
    const double x = omega * time;
    if (x < 0.05) {
        // Series up to x⁶: the next term is below the rounding of the sum.
        const double q = curve * time * time;
        const double s = time * (1 + q / 6 * (1 + q / 20 * (1 + q / 42)));
        const double c = 0.5 * time * time * (1 + q / 12 * (1 + q / 30 * (1 + q / 56)));
        const double arc_length = speed * s + acceleration * c;
        v = speed + s * acceleration + curve * c * speed;
        return arc_length;
    }
    const double s = curve > 0 ? std::sinh(x) : std::sin(x);
    const double half = curve > 0 ? std::sinh(0.5 * x) : std::sin(0.5 * x);
    const double c = 2 * half * half / (omega * omega);
    v = speed + s / omega * acceleration + curve * c * speed;
    return speed * s / omega + acceleration * c;
}

}  // namespace clsurf

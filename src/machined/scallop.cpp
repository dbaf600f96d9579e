#include "machined/scallop.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/not_finite.h"

namespace clsurf {

double scallop_height(double ball, double step_over, double rho) {
    if (!(ball > 0) || !(step_over >= 0)) throw std::domain_error("a ball and a step-over are positive");
    if (step_over >= 2 * ball)
        throw std::domain_error("the passes do not meet: the step-over is the ball's diameter or more");
    if (std::isinf(rho)) return ball - std::sqrt(ball * ball - 0.25 * step_over * step_over);
    const double radius = std::abs(rho);
    if (!(radius > 0) || step_over >= 2 * radius)
        throw std::domain_error("the step-over is too large for the curvature of the surface");
    const double sine = step_over / (2 * radius);
    const double cosine = std::sqrt(1 - sine * sine);
    if (rho > 0) {
        const double centre = radius + ball;
        if (centre * sine >= ball) throw std::domain_error("the passes do not meet on a surface of this curvature");
        return centre * cosine - std::sqrt(ball * ball - centre * centre * sine * sine) - radius;
    }
    if (ball >= radius) throw std::domain_error("the ball is larger than the hollow: it gouges");
    const double centre = radius - ball;
    return radius - centre * cosine - std::sqrt(ball * ball - centre * centre * sine * sine);
}

double cusp_height(double ball, double chord, double turn) {
    if (!std::isfinite(turn) || !(chord > 0) || chord >= 2 * ball) return missing<double>;
    const double curvature = turn / (chord * chord);  // > 0: normals diverge, the surface is convex
    if (curvature == 0) return scallop_height(ball, chord, std::numeric_limits<double>::infinity());
    if (curvature * ball <= -1) return missing<double>;  // the ball would gouge: no closed form
    const double sine = 0.5 * chord * std::abs(curvature);
    if (sine >= 1 || (curvature > 0 && (1 / curvature + ball) * sine >= ball)) return missing<double>;
    return scallop_height(ball, chord, 1 / curvature);
}

}  // namespace clsurf

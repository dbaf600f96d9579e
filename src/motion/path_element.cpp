#include "motion/path_element.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clsurf {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double same_angle = 1e-9;  ///< a difference of rounding size is a full circle, not none
constexpr double no_way = 1e-9;      ///< [mm] below it two points are one

}  // namespace

Vec3 PathElement::at(double way) const {
    if (!arc) return begin + way * direction;
    const double angle = rate * way;
    return centre + (radius + growth * angle) * (first * std::cos(angle) + second * std::sin(angle)) + rise * angle;
}

Vec3 PathElement::tangent(double way) const {
    if (!arc) return direction;
    const double angle = rate * way;
    const Vec3 outward = first * std::cos(angle) + second * std::sin(angle);
    const Vec3 along = second * std::cos(angle) - first * std::sin(angle);
    return rate * (growth * outward + (radius + growth * angle) * along + rise);
}

Vec3 PathElement::second_derivative(double way) const {
    if (!arc) return Vec3::Zero();
    const double angle = rate * way;
    const Vec3 outward = first * std::cos(angle) + second * std::sin(angle);
    const Vec3 along = second * std::cos(angle) - first * std::sin(angle);
    return rate * rate * (2 * growth * along - (radius + growth * angle) * outward);
}

Vec3 PathElement::third_derivative(double way) const {
    if (!arc) return Vec3::Zero();
    const double angle = rate * way;
    const Vec3 outward = first * std::cos(angle) + second * std::sin(angle);
    const Vec3 along = second * std::cos(angle) - first * std::sin(angle);
    return -rate * rate * rate * (3 * growth * outward + (radius + growth * angle) * along);
}

PathElement element_of(MotionKind kind, const Arc* arc, const Vec3& begin, const Vec3& end) {
    PathElement e;
    e.begin = begin;
    e.end = end;
    if (arc == nullptr) {
        const Vec3 way = end - begin;
        const double length = way.norm();
        if (length < no_way) return e;
        e.length = length;
        e.direction = way / length;
        return e;
    }
    const int w = arc->axis;
    const int u = (w + 1) % 3;
    const int v = (w + 2) % 3;
    const double turn = kind == MotionKind::ccw ? 1.0 : -1.0;
    e.arc = true;
    e.centre = arc->centre.vec();
    e.centre[w] = begin[w];
    const Vec2 from(begin[u] - e.centre[u], begin[v] - e.centre[v]);
    const Vec2 to(end[u] - e.centre[u], end[v] - e.centre[v]);
    e.radius = from.norm();
    if (e.radius < no_way) return e;
    double sweep = turn * (std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x()));
    while (sweep <= same_angle) sweep += two_pi;
    while (sweep > two_pi + same_angle) sweep -= two_pi;
    sweep += two_pi * (std::max(1, arc->turns) - 1);
    e.growth = (to.norm() - e.radius) / sweep;
    e.first[u] = from.x() / e.radius;
    e.first[v] = from.y() / e.radius;
    e.second[u] = -turn * e.first[v];
    e.second[v] = turn * e.first[u];
    e.rise[w] = (end[w] - begin[w]) / sweep;
    const double widest = std::max(e.radius, to.norm());
    e.rate = 1 / std::sqrt(widest * widest + e.rise.squaredNorm() + e.growth * e.growth);
    e.length = sweep / e.rate;
    return e;
}

}  // namespace clsurf

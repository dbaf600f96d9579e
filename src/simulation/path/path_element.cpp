#include "simulation/path/path_element.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "simulation/path/junction.h"

namespace clsurf {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double same_angle = 1e-9;  ///< a smaller angle is rounding and means a full circle
constexpr int turning_places = 8;    ///< number of places at which the direction of a cubic is evaluated

/// Derivatives of a curve by arc length, from its derivatives by a parameter u.
PathDerivatives by_arc_length(const Vec3& r1, const Vec3& r2, const Vec3& r3) {
    const double f = r1.squaredNorm();
    const double q = r1.dot(r2);
    const double u1 = 1 / std::sqrt(f);
    const double u2 = -q / (f * f);
    const double u3 = u1 * (4 * q * q / f - r2.squaredNorm() - r1.dot(r3)) / (f * f);
    return {u1 * r1, u1 * u1 * r2 + u2 * r1, u1 * u1 * u1 * r3 + 3 * u1 * u2 * r2 + u3 * r1};
}

}  // namespace

Vec3 PathElement::at(double arc_length) const {
    if (straight()) return begin + arc_length * direction;
    if (cubic) return curve.at(curve.at_arc_length(curve_from + arc_length, curve_length));
    if (spline) return spline->at(spline->at_arc_length(curve_from + arc_length));
    const double angle = rate * arc_length;
    return centre + (radius + growth * angle) * (first * std::cos(angle) + second * std::sin(angle)) + rise * angle;
}

Vec3 PathElement::at(double arc_length, Vec3& tangent) const {
    if (straight()) {
        tangent = direction;
        return begin + arc_length * direction;
    }
    if (cubic) {
        const double u = curve.at_arc_length(curve_from + arc_length, curve_length);
        tangent = curve.derivative(u).normalized();
        return curve.at(u);
    }
    if (spline) {
        const double t = spline->at_arc_length(curve_from + arc_length);
        tangent = spline->tangent(t);
        return spline->at(t);
    }
    const double angle = rate * arc_length;
    const Vec3 outward = first * std::cos(angle) + second * std::sin(angle);
    const Vec3 along = second * std::cos(angle) - first * std::sin(angle);
    tangent = rate * (growth * outward + (radius + growth * angle) * along + rise);
    return centre + (radius + growth * angle) * outward + rise * angle;
}

Vec3 PathElement::tangent(double arc_length) const {
    Vec3 tangent;
    (void)at(arc_length, tangent);
    return tangent;
}

PathDerivatives PathElement::derivatives(double arc_length) const {
    if (straight()) return {direction, Vec3::Zero(), Vec3::Zero()};
    if (cubic) {
        const double u = curve.at_arc_length(curve_from + arc_length, curve_length);
        return by_arc_length(curve.derivative(u), curve.second_derivative(u), 6 * curve.coefficients[3]);
    }
    if (spline) {
        const CurveJet jet = spline->moving_jet(spline->at_arc_length(curve_from + arc_length));
        return by_arc_length(jet.first, jet.second, jet.third);
    }
    const double angle = rate * arc_length;
    const Vec3 outward = first * std::cos(angle) + second * std::sin(angle);
    const Vec3 along = second * std::cos(angle) - first * std::sin(angle);
    const double distance = radius + growth * angle;
    return {rate * (growth * outward + distance * along + rise),
            rate * rate * (2 * growth * along - distance * outward),
            -rate * rate * rate * (3 * growth * outward + distance * along)};
}

double PathElement::turning() const {
    if (straight()) return 0;
    if (arc) return length * rate;
    if (spline && length == curve_length) return spline->turning();
    double sum = 0;
    Vec3 before = tangent(0);
    for (int k = 1; k <= turning_places; ++k) {
        const Vec3 here = tangent(length * k / turning_places);
        sum += deflection(before, here);
        before = here;
    }
    return sum;
}

PathElement PathElement::part(double from, double to) const {
    PathElement p = *this;
    p.length = to - from;
    if (from > 0) p.begin = at(from);
    if (to < length) p.end = at(to);
    if (!straight() && !arc) p.curve_from = curve_from + from;
    if (arc && from > 0) {
        const double angle = rate * from;
        p.first = first * std::cos(angle) + second * std::sin(angle);
        p.second = second * std::cos(angle) - first * std::sin(angle);
        p.radius = radius + growth * angle;
        p.centre = centre + rise * angle;
    }
    return p;
}

void PathElement::take_block(const PathElement& other) {
    feed = other.feed;
    tolerance = other.tolerance;
    merging_tolerance = other.merging_tolerance;
    line = other.line;
    block = other.block;
    block_length = other.block_length;
    deviation = other.deviation;
    greatest_speed = other.greatest_speed;
}

PathElement element_of(std::shared_ptr<const BezierCurve> spline) {
    PathElement e;
    e.begin = spline->at(0);
    e.end = spline->at(1);
    e.length = e.curve_length = spline->length();
    if (e.length < no_arc_length) e.length = 0;
    e.spline = std::move(spline);
    return e;
}

PathElement element_of(const CubicSpan& curve) {
    PathElement e;
    e.cubic = true;
    e.curve = curve;
    e.curve.choose_pieces();
    e.begin = curve.at(0);
    e.end = curve.at(curve.chord);
    e.length = e.curve_length = e.curve.arc_length_to(curve.chord);
    return e;
}

PathElement element_of(MotionKind kind, const Arc* arc, const Vec3& begin, const Vec3& end) {
    PathElement e;
    e.begin = begin;
    e.end = end;
    if (arc == nullptr) {
        const Vec3 chord = end - begin;
        const double length = chord.norm();
        if (length < no_arc_length) return e;
        e.length = length;
        e.direction = chord / length;
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
    if (e.radius < no_arc_length) return e;
    double sweep = turn * (angle_of(to) - angle_of(from));
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

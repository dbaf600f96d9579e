#include "toolpath/toolpath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clsurf {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// An arc or helix in its own frame: angle 0 at the start, increasing along the motion.
struct Helix {
    int u, v, w;           ///< axes of the plane, axis of rotation
    double sign;           ///< +1: angle grows from u to v
    double radius;         ///< at the start
    double radius_growth;  ///< from start to end (a spiral when the programmed radii differ)
    double sweep;          ///< > 0
    double rise;           ///< along w over the whole sweep
    double start_angle;
    Vec3 centre, begin;
};

Helix make_helix(const Arc& arc, MotionKind kind, const Vec3& begin, const Vec3& end) {
    Helix h{};
    h.w = arc.axis;
    h.u = (h.w + 1) % 3;
    h.v = (h.w + 2) % 3;
    h.sign = kind == MotionKind::ccw ? 1.0 : -1.0;
    h.centre = arc.centre.vec();
    h.begin = begin;
    const Vec2 from(begin[h.u] - h.centre[h.u], begin[h.v] - h.centre[h.v]);
    const Vec2 to(end[h.u] - h.centre[h.u], end[h.v] - h.centre[h.v]);
    h.radius = from.norm();
    h.radius_growth = to.norm() - h.radius;
    h.start_angle = angle_of(from);
    double sweep = h.sign * (angle_of(to) - h.start_angle);
    // A difference of the size of rounding is a full circle, not none.
    constexpr double same_angle = 1e-9;
    while (sweep <= same_angle) sweep += two_pi;
    while (sweep > two_pi + same_angle) sweep -= two_pi;
    h.sweep = sweep + two_pi * (std::max(1, arc.turns) - 1);
    h.rise = end[h.w] - begin[h.w];
    return h;
}

Vec3 point_of(const Helix& h, double fraction) {
    const double angle = h.start_angle + h.sign * h.sweep * fraction;
    const double radius = h.radius + h.radius_growth * fraction;
    Vec3 p;
    p[h.u] = h.centre[h.u] + radius * std::cos(angle);
    p[h.v] = h.centre[h.v] + radius * std::sin(angle);
    p[h.w] = h.begin[h.w] + h.rise * fraction;
    return p;
}

/// Derivative with respect to the fraction.
Vec3 derivative_of(const Helix& h, double fraction) {
    const double angle = h.start_angle + h.sign * h.sweep * fraction;
    const double radius = h.radius + h.radius_growth * fraction;
    const double turn = h.sign * h.sweep;
    Vec3 d;
    d[h.u] = h.radius_growth * std::cos(angle) - turn * radius * std::sin(angle);
    d[h.v] = h.radius_growth * std::sin(angle) + turn * radius * std::cos(angle);
    d[h.w] = h.rise;
    return d;
}

/// On a helix the angle of the nearest point differs from that of p, the more the steeper it is. Gauss–Newton steps from
/// the better one of two initial guesses.
void project_along_rise(const Helix& h, const Vec3& p, double from, Projection& best) {
    constexpr int most_steps = 6;
    const auto consider = [&](double fraction) {
        fraction = std::clamp(fraction, from, 1.0);
        const double distance = (point_of(h, fraction) - p).norm();
        const bool better = distance < best.distance;
        if (better) best = {distance, fraction};
        return better;
    };
    (void)consider((p[h.w] - h.begin[h.w]) / h.rise);
    for (int k = 0; k < most_steps; ++k) {
        const Vec3 slope = derivative_of(h, best.fraction);
        if (!consider(best.fraction + slope.dot(p - point_of(h, best.fraction)) / slope.squaredNorm())) return;
    }
}

Projection projection_on_helix(const Helix& h, const Vec3& p, double from) {
    const double angle = h.sign * (std::atan2(p[h.v] - h.centre[h.v], p[h.u] - h.centre[h.u]) - h.start_angle);
    // Candidates: the ends, and the same angle in every turn (the turn nearest in rise wins).
    Projection best{(point_of(h, from) - p).norm(), from};
    const auto consider = [&](double fraction) {
        if (fraction < from || fraction > 1.0) return;
        const double distance = (point_of(h, fraction) - p).norm();
        if (distance < best.distance) best = {distance, fraction};
    };
    consider(1.0);
    double a = std::fmod(angle, two_pi);
    if (a < 0) a += two_pi;
    for (; a <= h.sweep; a += two_pi) consider(a / h.sweep);
    if (h.rise != 0) project_along_rise(h, p, from, best);
    return best;
}

}  // namespace

std::shared_ptr<const BezierCurve> Toolpath::curve(std::int64_t motion) const {
    if (motions_->kind[static_cast<std::size_t>(motion)] != MotionKind::spline) return nullptr;
    const Curve* found = motions_->curve_of(motion);
    if (found == nullptr) return nullptr;
    if (!found->span->at(0).hasNaN()) return found->span;
    return std::make_shared<const BezierCurve>(found->span->with_unknown_at(rest_));
}

Vec3 Toolpath::at(std::int64_t motion, double fraction) const {
    const MotionKind kind = motions_->kind[static_cast<std::size_t>(motion)];
    if (const auto spline = curve(motion)) return spline->at(spline->at_arc_length(fraction * spline->length()));
    const Vec3 a = begin(motion);
    const Vec3 b = end(motion);
    const Arc* arc = is_arc(kind) ? motions_->arc_of(motion) : nullptr;
    return arc == nullptr ? Vec3(a + fraction * (b - a)) : point_of(make_helix(*arc, kind, a, b), fraction);
}

Vec3 Toolpath::direction(std::int64_t motion, double fraction) const {
    const MotionKind kind = motions_->kind[static_cast<std::size_t>(motion)];
    if (kind == MotionKind::dwell) return Vec3::Zero();
    if (const auto spline = curve(motion)) return spline->tangent(spline->at_arc_length(fraction * spline->length()));
    const Vec3 a = begin(motion);
    const Vec3 b = end(motion);
    const Arc* arc = is_arc(kind) ? motions_->arc_of(motion) : nullptr;
    const Vec3 along = arc == nullptr ? Vec3(b - a) : derivative_of(make_helix(*arc, kind, a, b), fraction);
    return along.isZero(0) ? Vec3::Zero() : Vec3(along.normalized());
}

double Toolpath::curvature(std::int64_t motion) const {
    if (const auto spline = curve(motion)) {
        constexpr int pieces = 32;
        double greatest = 0;
        for (int k = 0; k <= pieces; ++k) {
            const CurveJet jet = spline->moving_jet(static_cast<double>(k) / pieces);
            greatest = std::max(greatest, jet.first.cross(jet.second).norm() / std::pow(jet.first.norm(), 3));
        }
        return greatest;
    }
    const MotionKind kind = motions_->kind[static_cast<std::size_t>(motion)];
    const Arc* arc = is_arc(kind) ? motions_->arc_of(motion) : nullptr;
    if (arc == nullptr) return 0;
    const Helix h = make_helix(*arc, kind, begin(motion), end(motion));
    const double radius = std::min(h.radius, h.radius + h.radius_growth);
    const double rise_per_rad = h.rise / h.sweep;
    return radius / (radius * radius + rise_per_rad * rise_per_rad);
}

double Toolpath::length(std::int64_t motion) const {
    const MotionKind kind = motions_->kind[static_cast<std::size_t>(motion)];
    if (kind == MotionKind::dwell) return 0.0;
    if (const auto spline = curve(motion)) return spline->length();
    const Vec3 a = begin(motion);
    const Vec3 b = end(motion);
    const Arc* arc = is_arc(kind) ? motions_->arc_of(motion) : nullptr;
    if (arc == nullptr) return (b - a).norm();
    const Helix h = make_helix(*arc, kind, a, b);
    const double mean_radius = h.radius + 0.5 * h.radius_growth;
    return std::hypot(mean_radius * h.sweep, h.rise);
}

Projection Toolpath::projection(std::int64_t motion, const Vec3& p, double from) const {
    const MotionKind kind = motions_->kind[static_cast<std::size_t>(motion)];
    if (const auto spline = curve(motion)) {
        const double length = spline->length();
        const double from_t = from > 0 ? spline->at_arc_length(from * length) : 0.0;
        const BezierCurve::Nearest nearest = spline->nearest(p, from_t);
        const double fraction = length > 0 ? spline->arc_length_to(nearest.t) / length : 1.0;
        return {nearest.distance, std::clamp(fraction, from, 1.0)};
    }
    const Vec3 a = begin(motion);
    const Vec3 b = end(motion);
    if (is_arc(kind)) {
        if (const Arc* arc = motions_->arc_of(motion)) {
            return projection_on_helix(make_helix(*arc, kind, a, b), p, from);
        }
    }
    const Vec3 displacement = b - a;
    const double squared = displacement.squaredNorm();
    const double fraction = squared > 0 ? std::clamp((p - a).dot(displacement) / squared, from, 1.0) : 1.0;
    return {(a + fraction * displacement - p).norm(), fraction};
}

}  // namespace clsurf

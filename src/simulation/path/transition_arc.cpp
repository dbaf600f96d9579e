#include "simulation/path/transition_arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"
#include "numeric/root_between.h"
#include "simulation/path/junction.h"

namespace clsurf {
namespace {

// Limits of docs/simulate.md#2-corner-rounding (arcs) and docs/simulate.md#1-sections-between-stops.
constexpr double collinear = 0.01 * rad_per_deg;
constexpr double reversal = 179.0 * rad_per_deg;
constexpr double least_arc_length = 1e-7;  ///< [mm] a shorter tangent is rounding
constexpr double plane_tolerance = 1e-9;   ///< greatest distance from the plane of the tangents, relative to the chord
constexpr double most_of_turn = 0.9;       ///< share of a block's turn until the arc would be a half circle

/// The root of f between 0, where f is negative, and `high`, where it is not.
template <typename F>
double arc_length_to_root(double high, const F& f) {
    return root_between(0, f(0), high, f(high), 1e-14, 0, f);
}

/// One block, measured from the corner outwards.
class Arm {
public:
    Arm(const PathElement& element, bool before) : element_(&element), before_(before) {}
    [[nodiscard]] Vec3 point(double arc_length) const {
        return element_->at(before_ ? element_->length - arc_length : arc_length);
    }
    /// In the direction of travel, unit.
    [[nodiscard]] Vec3 tangent(double arc_length) const {
        return element_->tangent(before_ ? element_->length - arc_length : arc_length).normalized();
    }
    /// Half the block, and on a curved block less than the length at which the arc would be a half circle.
    [[nodiscard]] double share(double deflection) const {
        const double bend = element_->second_derivative(before_ ? element_->length : 0).norm();
        const double half = 0.5 * element_->length;
        return bend > 0 ? std::min(half, most_of_turn * 0.5 * (std::numbers::pi - deflection) / bend) : half;
    }

private:
    const PathElement* element_;
    bool before_;
};

/// Two blocks at their corner; angles are measured in the plane of their tangents there.
class Corner {
public:
    Corner(const PathElement& before, const PathElement& after, double deflection)
        : before_(before, true),
          after_(after, false),
          normal_(before_.tangent(0).cross(after_.tangent(0)).normalized()),
          share_before_(before_.share(deflection)),
          share_after_(after_.share(deflection)) {}

    /// Positive if the place on `after` is too far out for a circle through both places: the turn of the chord minus half
    /// the turn between the tangents.
    [[nodiscard]] double imbalance(double arc_length_before, double arc_length_after) const {
        const Vec3 t0 = before_.tangent(arc_length_before);
        const Vec3 chord = after_.point(arc_length_after) - before_.point(arc_length_before);
        return angle(t0, chord) - 0.5 * angle(t0, after_.tangent(arc_length_after));
    }
    [[nodiscard]] double arc_length_after(double arc_length_before) const {
        return arc_length_to_root(share_after_,
                                  [&](double arc_length) { return imbalance(arc_length_before, arc_length); });
    }
    [[nodiscard]] double arc_length_before(double arc_length_after) const {
        return arc_length_to_root(share_before_,
                                  [&](double arc_length) { return -imbalance(arc_length, arc_length_after); });
    }
    /// The circle through one place on each block.
    [[nodiscard]] TransitionArc circle(double arc_length_before, double arc_length_after) const {
        TransitionArc arc;
        arc.arc_length_before = arc_length_before;
        arc.arc_length_after = arc_length_after;
        arc.begin = before_.point(arc_length_before);
        arc.end = after_.point(arc_length_after);
        arc.tangent = before_.tangent(arc_length_before);
        const Vec3 leaving = after_.tangent(arc_length_after);
        const Vec3 chord = arc.end - arc.begin;
        arc.sweep = angle(arc.tangent, leaving);
        arc.radius = 0.5 * chord.norm() / std::sin(0.5 * arc.sweep);
        const Vec3 inward = normal_.cross(arc.tangent);
        arc.centre = arc.begin + arc.radius * inward;
        arc.middle = arc.centre - arc.radius * normal_.cross(chord).normalized();
        arc.error = std::abs((before_.point(0) - arc.centre).norm() - arc.radius);
        const Vec3 along = (arc.tangent + leaving).normalized();
        const bool tangent_to_both = (chord - chord.norm() * along).norm() <= plane_tolerance * chord.norm() &&
                                     std::abs(arc.tangent.dot(normal_)) <= plane_tolerance;
        arc.kind = tangent_to_both && arc.sweep > 0 ? CornerKind::arc : CornerKind::none;
        return arc;
    }
    /// The greatest arc that the shares allow; kind `none` if there is none.
    [[nodiscard]] TransitionArc longest() const {
        if (imbalance(share_before_, share_after_) >= 0) return circle(share_before_, arc_length_after(share_before_));
        return circle(arc_length_before(share_after_), share_after_);
    }

private:
    [[nodiscard]] double angle(const Vec3& from, const Vec3& to) const {
        return std::atan2(normal_.dot(from.cross(to)), from.dot(to));
    }

    Arm before_, after_;
    Vec3 normal_;
    double share_before_, share_after_;
};

}  // namespace

double radius_at_error(double deflection, double error) {
    // 1 − cos from the sine, which has no cancellation.
    const double s = std::sin(0.25 * deflection);
    return error * std::cos(0.5 * deflection) / (2 * s * s);
}

TransitionArc transition_arc(const PathElement& before, const PathElement& after, double error) {
    TransitionArc none;
    if (!(before.length > 0) || !(after.length > 0)) return none;
    none.deflection = deflection(before.tangent(before.length).normalized(), after.tangent(0).normalized());
    none.kind = none.deflection < collinear  ? CornerKind::collinear
                : none.deflection > reversal ? CornerKind::reversal
                                             : CornerKind::none;
    if (none.kind != CornerKind::none) return none;
    const Corner corner(before, after, none.deflection);
    TransitionArc arc;
    ArcLimit limited = ArcLimit::length;
    if (before.straight() && after.straight()) {
        const double asked = radius_at_error(none.deflection, error) * std::tan(0.5 * none.deflection);
        const double share = 0.5 * std::min(before.length, after.length);
        limited = asked < share ? ArcLimit::error : ArcLimit::length;
        arc = corner.circle(std::min(asked, share), std::min(asked, share));
    } else {
        arc = corner.longest();
        if (arc.kind == CornerKind::arc && arc.error > error) {
            const auto excess = [&](double arc_length) {
                return corner.circle(arc_length, corner.arc_length_after(arc_length)).error - error;
            };
            const double arc_length = arc_length_to_root(arc.arc_length_before, excess);
            arc = corner.circle(arc_length, corner.arc_length_after(arc_length));
            limited = ArcLimit::error;
        }
    }
    if (arc.kind != CornerKind::arc || std::min(arc.arc_length_before, arc.arc_length_after) < least_arc_length)
        return none;
    arc.deflection = none.deflection;
    arc.limited = limited;
    return arc;
}

PathElement TransitionArc::element() const {
    PathElement e;
    e.arc = true;
    e.begin = begin;
    e.end = end;
    e.centre = centre;
    e.first = (begin - centre) / radius;
    e.second = tangent;
    e.radius = radius;
    e.rate = 1 / radius;
    e.length = radius * sweep;
    return e;
}

}  // namespace clsurf

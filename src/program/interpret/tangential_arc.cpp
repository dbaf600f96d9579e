// Arcs that go on in the direction of the last motion, even if that is no longer in memory.

#include <cmath>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr double least_displacement = 1e-12;  ///< [mm] that has a direction

}  // namespace

/// G06, G16 and CT: the arc goes on in the direction of the last motion.
void Interpreter::arc_along_tangent(ArcWords& words) const {
    const int u = (words.axis + 1) % 3;
    const int v = (words.axis + 2) % 3;
    const Vec2 displacement(words.end[u] - words.begin[u], words.end[v] - words.begin[v]);
    const Vec2 tangent = end_tangent(u, v);
    const double across = tangent.x() * displacement.y() - tangent.y() * displacement.x();
    if (tangent.isZero()) fail("a tangential arc needs a motion before it");
    if (std::abs(across) < least_displacement) fail("a tangential arc to a point straight ahead is a line");
    const double radius = displacement.squaredNorm() / (2 * across);  // left: positive
    words.centre = words.begin;
    words.centre[u] -= radius * tangent.y();
    words.centre[v] += radius * tangent.x();
    words.clockwise = radius < 0;
}

/// Direction in which a motion ends, as long as its way or radius; of an arc in its own plane. Zero: there is none.
Vec3 Interpreter::tangent_at_end(std::int64_t motion) const {
    const Motions& m = program_.motions;
    const auto i = static_cast<std::size_t>(motion);
    if (m.kind[i] == MotionKind::dwell) return Vec3::Zero();
    if (const Curve* curve = m.curve_of(motion)) return curve->span->tangent(1);
    const Arc* arc = m.arc_of(motion);
    if (arc == nullptr) return m.end[i].vec() - m.begin_of(motion).vec();
    Vec3 out = m.end[i].vec() - arc->centre.vec();
    out[arc->axis] = 0;
    const Vec3 axis = Vec3::Unit(arc->axis);
    return m.kind[i] == MotionKind::ccw ? axis.cross(out) : out.cross(axis);
}

/// What end_tangent() may ask of motions that are forgotten: in a plane that the last way stands on, the last one that
/// is not parallel to it has a direction.
void Interpreter::keep_tangents(std::int64_t motions) {
    std::vector<Vec3> tangents;
    const auto add = [&tangents](const Vec3& displacement) {
        const bool known = (displacement.array().isFinite() && displacement.array().abs() > least_displacement).any();
        if (known && (tangents.empty() ||
                      !(tangents.front().cross(displacement).norm() <= least_displacement * tangents.front().norm())))
            tangents.push_back(displacement);
    };
    for (std::int64_t i = motions; i-- > 0 && tangents.size() < 2;) add(tangent_at_end(i));
    for (const Vec3& displacement : forgotten_tangents_) {
        if (tangents.size() < 2) add(displacement);
    }
    forgotten_tangents_ = std::move(tangents);
}

/// Direction in which the last motion ends, in programmed coordinates; zero: there is none.
Vec2 Interpreter::end_tangent(int u, int v) const {
    const auto in_plane = [&](const Vec3& displacement) {
        const Vec3 programmed = state_.frame.direction_to_programmed(displacement);
        const Vec2 tangent(programmed[u], programmed[v]);
        return tangent.allFinite() && tangent.norm() > least_displacement ? Vec2(tangent.normalized())
                                                                          : Vec2(Vec2::Zero());
    };
    Vec2 tangent = Vec2::Zero();
    for (std::int64_t i = program_.motions.size(); i-- > 0 && tangent.isZero(0);) tangent = in_plane(tangent_at_end(i));
    for (std::size_t i = 0; i < forgotten_tangents_.size() && tangent.isZero(0); ++i)
        tangent = in_plane(forgotten_tangents_[i]);
    return tangent;
}

}  // namespace clsurf

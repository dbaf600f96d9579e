// Arcs that continue in the direction of the last motion, even if that is no longer in memory.

#include "program/interpret/tangential_arc.h"

#include <cmath>
#include <utility>
#include <vector>

#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr double least_displacement = 1e-12;  ///< [mm] shorter ones have no direction

/// Direction at the end of the last motion, in programmed coordinates; zero if there is none.
Vec2 end_tangent(const Interpreter& in, int u, int v) {
    const auto in_plane = [&](const Vec3& displacement) {
        const Vec3 programmed = in.state_.frame.direction_to_programmed(displacement);
        const Vec2 tangent(programmed[u], programmed[v]);
        return tangent.allFinite() && tangent.norm() > least_displacement ? Vec2(tangent.normalized())
                                                                          : Vec2(Vec2::Zero());
    };
    Vec2 tangent = Vec2::Zero();
    for (std::int64_t i = in.program_.motions.size(); i-- > 0 && tangent.isZero(0);)
        tangent = in_plane(tangent_at_end(in.program_.motions, i));
    for (std::size_t i = 0; i < in.forgotten_tangents_.size() && tangent.isZero(0); ++i)
        tangent = in_plane(in.forgotten_tangents_[i]);
    return tangent;
}

}  // namespace

void arc_along_tangent(const Interpreter& in, ArcWords& words) {
    const int u = (words.axis + 1) % 3;
    const int v = (words.axis + 2) % 3;
    const Vec2 displacement(words.end[u] - words.begin[u], words.end[v] - words.begin[v]);
    const Vec2 tangent = end_tangent(in, u, v);
    const double across = tangent.x() * displacement.y() - tangent.y() * displacement.x();
    if (tangent.isZero()) in.fail("a tangential arc needs a motion before it");
    if (std::abs(across) < least_displacement) in.fail("a tangential arc to a point straight ahead is a line");
    const double radius = displacement.squaredNorm() / (2 * across);  // left: positive
    words.centre = words.begin;
    words.centre[u] -= radius * tangent.y();
    words.centre[v] += radius * tangent.x();
    words.clockwise = radius < 0;
}

Vec3 tangent_at_end(const Motions& motions, std::int64_t motion) {
    const Motions& m = motions;
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

void keep_tangents(std::vector<Vec3>& kept, const Motions& motions, std::int64_t count) {
    std::vector<Vec3> tangents;
    const auto add = [&tangents](const Vec3& displacement) {
        const bool known = (displacement.array().isFinite() && displacement.array().abs() > least_displacement).any();
        if (known && (tangents.empty() ||
                      !(tangents.front().cross(displacement).norm() <= least_displacement * tangents.front().norm())))
            tangents.push_back(displacement);
    };
    for (std::int64_t i = count; i-- > 0 && tangents.size() < 2;) add(tangent_at_end(motions, i));
    for (const Vec3& displacement : kept) {
        if (tangents.size() < 2) add(displacement);
    }
    kept = std::move(tangents);
}

}  // namespace clsurf

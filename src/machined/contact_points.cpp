#include "machined/contact_points.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"
#include "core/point_ranges.h"
#include "log/quantum.h"
#include "machined/contact.h"

namespace clsurf {
namespace {

constexpr double carried_along = 3;        ///< step-overs along the path: farthest that a normal is carried
constexpr PointIndex longest_walk = 4096;  ///< number of points; a limit because the tool may rest
constexpr double straight = 0.35;          ///< sine of the largest angle between directions across for an extrapolation
constexpr double rounding = 1e-6;          ///< [mm] of positions without a grid
constexpr double level_steps = 1.5;        ///< quanta per step-over by which rounding tilts a level surface
constexpr double least_square = 0.1;       ///< least sine of the angle between normal and feed for a projection
constexpr int most_iterations = 12;        ///< of a normal under a tool that turns
constexpr double near_end = 0.5;           ///< share of the other half of the chord: a shorter half is at an end
constexpr double settled = 1e-5;           ///< change of a normal that ends the iterations

double finest_quantum(const Trajectory& path) {
    double finest = 0;
    for (const ChannelView& axis : path.axes) {
        const double quantum = quantum_of(axis);
        if (quantum > 0 && (finest == 0 || quantum < finest)) finest = quantum;
    }
    return std::max(finest, rounding);
}

Vec3 no_normal() { return Vec3::Constant(missing<double>); }

}  // namespace

bool stays_low(const Positions& p, const Pass& link, double step_over) {
    const auto before = static_cast<std::size_t>(std::max<PointIndex>(0, link.first - 1));
    const auto after = static_cast<std::size_t>(std::min(p.size() - 1, link.last + 1));
    p.fill.need(static_cast<PointIndex>(before), static_cast<PointIndex>(after));
    const float most = std::max(p.z[before], p.z[after]) + static_cast<float>(step_over);
    for (PointIndex i = link.first; i <= link.last; ++i) {
        if (!(p.z[static_cast<std::size_t>(i)] <= most)) return false;
    }
    return true;
}

ContactPoints::ContactPoints(const ClSurface& surface, const Trajectory& path, std::optional<ToolAxes> axes,
                             const CuttingTool& tool)
    : surface_(surface),
      path_(path),
      axes_(std::move(axes)),
      tool_(tool),
      half_chord_(0.5 * (surface.step_over > 0 ? surface.step_over : 0.1 * tool.radius)),
      level_(level_steps * finest_quantum(path) / (2 * half_chord_)) {}

double ContactPoints::reach() const { return std::hypot(tool_.radius, tool_.corner); }

bool ContactPoints::cuts(const Pass& piece) const {
    if (piece.kind == PassKind::cut) return true;
    return piece.kind == PassKind::link && stays_low(surface_.positions, piece, surface_.step_over);
}

std::optional<Vec3> ContactPoints::at(PointIndex point) const {
    Vec3 n = normal(point);
    if (!n.allFinite()) return std::nullopt;
    const Vec3 axis = axis_at({point, 0});
    if ((n - n.dot(axis) * axis).norm() < level_) n = axis;
    const Vec3 contact = path_.at(point) + contact_offset(tool_, n, axis);
    if (!contact.allFinite()) return std::nullopt;
    return contact;
}

Vec3 ContactPoints::normal(PointIndex point) const {
    const Pass* pass = pass_of(point);
    if (pass == nullptr || !cuts(*pass) || !surface_.positions[point].allFinite()) return no_normal();
    const PointRange range{pass->first, pass->last};
    if (pass->kind == PassKind::cut && surface_.step_over > 0) {
        const Vec3 found = normal_by_neighbours(point, range);
        if (found.allFinite()) return found;
    }
    return normal_from_along(point, range);
}

const Pass* ContactPoints::pass_of(PointIndex point) const {
    return any_has(surface_.passes, point) ? &*range_at(surface_.passes, point) : nullptr;
}

/// The first point `distance` [mm] along the path from another (< 0: before it), or the last one within a range.
PointIndex ContactPoints::walk(PointIndex point, PointRange within, double distance) const {
    const Positions& p = surface_.positions;
    const PointIndex step = distance < 0 ? -1 : 1;
    double gone = 0;
    PointIndex at = point;
    for (PointIndex walked = 0; walked < longest_walk && gone < std::abs(distance); ++walked) {
        const PointIndex next = at + step;
        if (next < within.first || next > within.last || !p[next].allFinite()) break;
        gone += (p[next] - p[at]).norm();
        at = next;
    }
    return at;
}

std::optional<ContactPoints::Direction> ContactPoints::across_at(PointIndex point, const Eigen::Vector3f& feed) const {
    const PathLocation here{point, 0};
    const PathLocation left = adjacent_location(surface_, here, feed, Side::left);
    const PathLocation right = adjacent_location(surface_, here, feed, Side::right);
    if (!left.exists() && !right.exists()) return std::nullopt;
    if (left.exists() && right.exists()) return Direction{right, left, {}, {}};
    // Every second pass of a zigzag may be slightly displaced: steps over two passes are not affected.
    const PathLocation first = left.exists() ? left : right;
    const PathLocation second = beyond(surface_, here, first, feed);
    if (!second.exists()) return Direction{first, here, {}, {}};
    const PathLocation third = beyond(surface_, first, second, feed);
    return third.exists() ? Direction{second, here, third, first} : Direction{second, here, {}, {}};
}

ContactPoints::Frame ContactPoints::make_frame(PointIndex point, PointRange pass) const {
    const Positions& p = surface_.positions;
    PointIndex first = walk(point, pass, -half_chord_);
    PointIndex last = walk(point, pass, half_chord_);
    const auto apart = [&](PointIndex a, PointIndex b) { return static_cast<double>((p[b] - p[a]).norm()); };
    Frame frame{{{first, 0}, {last, 0}, {}, {}}, {}};
    // At an end of the pass there is a chord on one side only; the next chord is used to extrapolate.
    if (apart(first, point) < near_end * apart(point, last)) {
        first = point;
        frame.along = {{point, 0}, {last, 0}, {last, 0}, {walk(last, pass, half_chord_), 0}};
    } else if (apart(point, last) < near_end * apart(first, point)) {
        last = point;
        frame.along = {{first, 0}, {point, 0}, {walk(first, pass, -half_chord_), 0}, {first, 0}};
    }
    const Eigen::Vector3f chord = p[last] - p[first];
    if (!(chord.squaredNorm() > 0)) return frame;
    for (const PointIndex i : {point, first, last}) {
        if (const std::optional<Direction> across = across_at(i, chord)) frame.across.push_back(*across);
        // At an end, the other places are on one side of the point.
        if ((first == point || last == point) && !frame.across.empty()) break;
    }
    return frame;
}

Vec3 ContactPoints::axis_at(const PathLocation& at) const {
    if (!axes_) return Vec3::UnitZ();
    const Vec3 axis = axes_->at(at.point);
    if (at.fraction == 0) return axis;
    return (axis + static_cast<double>(at.fraction) * (axes_->at(at.point + 1) - axis)).normalized();
}

/// The point of the tool that moves on a surface with the given normal (see the top of the header) [mm], relative to the
/// origin of the positions.
Vec3 ContactPoints::tool_point(const PathLocation& at, const Vec3& normal) const {
    const Vec3 tip = position_at(surface_.positions, at).cast<double>();
    if (!axes_) return tip;
    const Vec3 axis = axis_at(at);
    const Vec3 aside = normal - normal.dot(axis) * axis;
    const double tilt = aside.norm();
    const double bottom = tilt > level_ ? (tool_.radius - tool_.corner) / tilt : 0;
    return tip + tool_.corner * axis - bottom * aside;
}

Vec3 ContactPoints::normal_by_neighbours(PointIndex point, PointRange pass) const {
    const Frame frame = make_frame(point, pass);
    if (frame.across.empty()) return no_normal();
    const Vec3 axis = axis_at({point, 0});
    const auto estimate = [&](const Vec3& normal) {
        const auto from_to = [&](const PathLocation& from, const PathLocation& to) {
            return Vec3((tool_point(to, normal) - tool_point(from, normal)).normalized());
        };
        const auto direction_of = [&](const Direction& d) {
            const Vec3 here = from_to(d.from, d.to);
            if (!d.before.exists()) return here;
            const Vec3 inner = from_to(d.before, d.towards);
            const bool smooth = inner.cross(here).norm() < straight && inner.dot(here) > 0;
            return smooth ? Vec3((2 * here - inner).normalized()) : here;
        };
        const Vec3 along = direction_of(frame.along);
        Vec3 across = Vec3::Zero();
        for (const Direction& a : frame.across) {
            const Vec3 direction = direction_of(a);
            across += across.dot(direction) < 0 ? Vec3(-direction) : direction;
        }
        const Vec3 n = along.cross(across).normalized();
        return n.dot(axis) < 0 ? Vec3(-n) : n;
    };
    Vec3 normal = estimate(axis);
    if (!axes_ || tool_.radius == tool_.corner) return normal;
    for (int k = 0; k < most_iterations && normal.allFinite(); ++k) {
        const Vec3 next = (normal + 2 * estimate(normal)).normalized();
        const bool done = (next - normal).norm() < settled;
        normal = next;
        if (done) break;
    }
    return normal;
}

/// The normal for links, and for points without an adjacent pass.
Vec3 ContactPoints::normal_from_along(PointIndex point, PointRange piece) const {
    const Positions& p = surface_.positions;
    const Eigen::Vector3f chord = p[walk(point, piece, half_chord_)] - p[walk(point, piece, -half_chord_)];
    const Vec3 feed = chord.cast<double>().normalized();
    if (!feed.allFinite()) return no_normal();
    Vec3 sum = Vec3::Zero();
    if (surface_.step_over <= 0) sum = axis_at({point, 0});  // a single pass: upright, except for its slope
    for (const PointIndex step : {PointIndex{-1}, PointIndex{1}}) {
        if (surface_.step_over <= 0) break;
        double gone = 0;
        PointIndex at = point;
        for (PointIndex walked = 0; walked < longest_walk && gone < carried_along * surface_.step_over; ++walked) {
            const PointIndex next = at + step;
            if (next < 0 || next >= p.size() || !p[next].allFinite()) break;
            gone += (p[next] - p[at]).norm();
            at = next;
            if (!surface_.neighbours.has(Side::left, at) && !surface_.neighbours.has(Side::right, at)) continue;
            const Pass* pass = pass_of(at);
            const Vec3 there = normal_by_neighbours(at, {pass->first, pass->last});
            if (!there.allFinite()) continue;
            sum += there / (gone + half_chord_);
            break;
        }
    }
    const Vec3 square = sum.normalized() - sum.normalized().dot(feed) * feed;
    return square.norm() > least_square ? Vec3(square.normalized()) : no_normal();
}

}  // namespace clsurf

#include "simulation/plan/blend_arc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clsurf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double no_angle = 1e-6;             ///< [rad] a smaller angle of a corner or an arc counts as none
constexpr double least_arc = 1e-6;            ///< [mm]
constexpr double least_radius = 1e-12;        ///< [mm]
constexpr double sharpest_of_arcs = pi / 12;  ///< smallest half angle of a corner between two arcs [rad]
constexpr double tangent_share = 0.25;        ///< share of the normal acceleration for direction errors of a blend
// A quarter of the shorter block: docs/simulate.md#the-trapezoidal-planner, point 4.
constexpr double tolerance_share = 0.25;  ///< deviation of a parabola over half of a block, relative to the block

/// One of the two blocks of a corner.
struct Side {
    const BlendSegment* segment = nullptr;
    bool first = true;
    Vec3 tangent = Vec3::Zero();    ///< at the corner, in the direction of travel
    Vec3 direction = Vec3::Zero();  ///< of the line that approximates the block: the tangent or a chord
    Vec3 centre = Vec3::Zero();     ///< of an arc
    double radius = 0;
    bool turns_away = false;    ///< the arc curves away from the inside of the corner
    double greatest_angle = 0;  ///< greatest angle of an arc that the blend may replace [rad]
    double length = 0;          ///< greatest length of the block that it may replace [mm]
};

Side side_of(const BlendSegment& segment, bool first) {
    Side side;
    side.segment = &segment;
    side.first = first;
    side.tangent = side.direction = first ? segment.end_tangent() : segment.start_tangent();
    side.length = first ? std::min(segment.length, 0.5 * segment.nominal_length) : 0.5 * segment.length;
    return side;
}

/// Replaces an arc that curves away from the corner by its chord; lowers the half angle accordingly.
void take_arc(Side& side, const Vec3& corner, const Vec3& other_tangent, double half_angle, double& effective) {
    const PathElement& arc = side.segment->path;
    if (!side.segment->curved()) return;
    side.centre = arc.centre + arc.growth * side.tangent;
    side.radius = (corner - side.centre).norm();
    const double outward = (corner - side.centre).dot(other_tangent);
    side.turns_away = side.first ? outward < 0 : outward >= 0;
    const double sweep = side.segment->sweep();
    side.greatest_angle = std::min(side.first ? sweep * 2 / 3 : sweep / 3, side.turns_away ? half_angle : pi / 2);
    side.length = side.greatest_angle * side.radius;
    if (!side.turns_away) return;
    const double place = 0.5 * side.greatest_angle / arc.rate;
    const Vec3 chord = side.first ? Vec3(corner - arc.at(arc.length - place)) : Vec3(arc.at(place) - corner);
    side.direction = chord.normalized();
    effective = std::min(effective, half_angle - 0.25 * side.greatest_angle);
    side.length = std::sin(0.25 * side.greatest_angle) * side.radius;
}

/// Whether the arc is in the plane of the corner.
bool lies_in_plane(const Side& side, const Vec3& binormal) {
    if (!side.segment->curved()) return true;
    const Vec3 normal = side.segment->path.first.cross(side.segment->path.second);
    return std::min((normal - binormal).norm(), (normal + binormal).norm()) < no_angle;
}

double tolerance_of(const BlendSegment& segment) {
    return segment.tolerance > 0 ? segment.tolerance : tolerance_share * segment.nominal_length;
}

double limited_feed(const BlendSegment& segment, double override_factor) {
    return std::min(segment.feed * override_factor, segment.max_speed);
}

/// The speed at a corner between two lines: the altitude of the triangle of both velocities, from the corner to the third
/// side.
double speed_between(const BlendSegment& before, const BlendSegment& after, const Vec3& in, const Vec3& out,
                     double turning) {
    const double cosine = std::cos(std::min(turning, 0.49 * pi));
    const double a = std::min(before.max_speed, after.max_speed / cosine);
    const double b = std::min(after.max_speed, before.max_speed / cosine);
    return a * b * std::sin(turning) / (b * out - a * in).norm();
}

Vec3 of_axes(const Machine& machine, double MachineAxis::*limit) {
    return {machine.axes[0].*limit, machine.axes[1].*limit, machine.axes[2].*limit};
}

/// The centre of the arc that touches both blocks on the inside of the corner. NaN: there is none.
Vec3 centre_of(const Side& in, const Side& out, const Vec3& corner, const Vec3& binormal, double radius,
               double half_angle) {
    const auto distance = [&](const Side& side) { return side.radius + (side.turns_away ? -radius : radius); };
    if (!in.segment->curved() && !out.segment->curved())
        return corner + radius / std::sin(half_angle) * (out.tangent - in.tangent).normalized();
    if (in.segment->curved() && out.segment->curved()) {
        // Circles about the centres of both blocks. Of their two intersections the one nearer to the corner is used.
        const Vec3 between = out.centre - in.centre;
        const double apart = between.norm();
        const double r1 = distance(in), r2 = distance(out);
        const double along = (r1 * r1 - r2 * r2 + apart * apart) / (2 * apart);
        const double aside = std::sqrt(r1 * r1 - along * along);  // NaN if they do not intersect
        const Vec3 unit = between / apart;
        const Vec3 projection = in.centre + along * unit;
        const Vec3 offset = aside * binormal.cross(unit).normalized();
        return (projection + offset - corner).norm() < (projection - offset - corner).norm()
                   ? Vec3(projection + offset)
                   : Vec3(projection - offset);
    }
    // A parallel of the line at the distance of the radius, and a circle about the centre of the other block.
    const bool line_first = !in.segment->curved();
    const Side& line = line_first ? in : out;
    const Side& arc = line_first ? out : in;
    const Vec3 inward = binormal.cross(line.tangent).normalized();
    const Vec3 to_centre = arc.centre - corner;
    const double along = to_centre.dot(line.tangent), beside = to_centre.dot(inward) - radius;
    const double half_chord = std::sqrt(distance(arc) * distance(arc) - beside * beside);
    const double trim = std::min(std::abs(along + half_chord), std::abs(along - half_chord));
    return corner + (line_first ? -trim : trim) * line.tangent + radius * inward;
}

/// Length of a block that the arc replaces [mm].
double trim_of(const Side& side, const Vec3& corner, const Vec3& centre) {
    if (!side.segment->curved()) return std::abs((centre - corner).dot(side.tangent));
    const Vec3 a = (corner - side.centre).normalized(), b = (centre - side.centre).normalized();
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) / side.segment->path.rate;
}

/// The arc from one point to another about a centre; its radius may grow along it.
PathElement arc_between(const Vec3& from, const Vec3& to, const Vec3& centre, const Vec3& binormal) {
    PathElement arc;
    arc.arc = true;
    arc.begin = from;
    arc.end = to;
    arc.centre = centre;
    arc.radius = (from - centre).norm();
    const double end_radius = (to - centre).norm();
    arc.first = (from - centre) / arc.radius;
    arc.second = binormal.cross(arc.first).normalized();
    const double sweep = std::acos(std::clamp(arc.first.dot(to - centre) / end_radius, -1.0, 1.0));
    arc.growth = (end_radius - arc.radius) / sweep;
    arc.rate = 1 / arc.radius;
    arc.length = arc.radius * sweep;
    return arc;
}

/// Whether the arc and a block have the same direction where they meet, up to what a share of the acceleration permits.
bool meets(const Side& side, const PathElement& block, const PathElement& arc, double speed, double acceleration,
           double period) {
    if (!side.segment->curved()) return true;
    const Vec3 of_block = (side.first ? block.tangent(block.length) : block.tangent(0)).normalized();
    const Vec3 of_arc = (side.first ? arc.tangent(0) : arc.tangent(arc.length)).normalized();
    const double angle = 2 * std::atan2((of_block - of_arc).norm(), (of_block + of_arc).norm());
    return angle <= normal_share * tangent_share * acceleration * period / speed;
}

/// Shortens a block by what the arc replaces.
void cut(BlendSegment& segment, double from, double to) {
    segment.path = segment.path.part(from, to);
    segment.length = segment.path.length;
}

/// A corner with both of its sides.
struct CornerSides {
    Side in, out;
    Vec3 point = Vec3::Zero(), binormal = Vec3::Zero();
    BlendCorner limits;

    [[nodiscard]] bool of_lines() const { return !in.segment->curved() && !out.segment->curved(); }
};

/// The data that limit the arc of a corner. nullopt: the corner is straight, a reversal, or not in one plane.
std::optional<CornerSides> corner_of(const BlendSegment& before, const BlendSegment& after, const Machine& machine) {
    CornerSides corner;
    Side& in = corner.in = side_of(before, true);
    Side& out = corner.out = side_of(after, false);
    corner.point = after.path.begin;
    const double half_angle = half_corner_angle(in.tangent, out.tangent);
    if (half_angle < no_angle || pi / 2 - half_angle < no_angle) return std::nullopt;
    corner.binormal = in.tangent.cross(out.tangent).normalized();
    BlendCorner& limits = corner.limits;
    limits.half_angle = half_angle;
    take_arc(in, corner.point, out.tangent, half_angle, limits.half_angle);
    take_arc(out, corner.point, in.tangent, half_angle, limits.half_angle);
    if (!lies_in_plane(in, corner.binormal) || !lies_in_plane(out, corner.binormal)) return std::nullopt;
    if (before.curved() && after.curved() && limits.half_angle < sharpest_of_arcs) return std::nullopt;
    limits.length_in = in.length;
    limits.length_out = out.length;
    limits.tolerance = std::min({tolerance_of(before), tolerance_of(after), tolerance_share * before.nominal_length,
                                 tolerance_share * after.nominal_length});
    const PathLimits& path = machine.path;
    const double plane = least_in_plane(corner.binormal, of_axes(machine, &MachineAxis::max_acceleration));
    limits.acceleration = std::min(plane, path.max_acceleration);
    limits.normal_acceleration = std::min(normal_share * limits.acceleration, path.max_normal_acceleration);
    double speed = least_in_plane(corner.binormal, of_axes(machine, &MachineAxis::max_speed));
    if (corner.of_lines())
        speed = std::max(speed, speed_between(before, after, in.tangent, out.tangent, pi - 2 * limits.half_angle));
    const double most = machine.controller.trapezoid.max_feed_override;
    limits.speed = std::min(speed, std::max(limited_feed(before, most), limited_feed(after, most)));
    return corner;
}

/// Sets the limits of an arc between two blocks.
void finish_arc(BlendSegment& arc, const CornerSides& corner, double speed, double period) {
    const BlendSegment& before = *corner.in.segment;
    const BlendSegment& after = *corner.out.segment;
    arc.path.take_block(after.path);
    arc.blend = true;
    arc.rapid = before.rapid;
    arc.lead_tangent = corner.in.tangent;
    arc.length = arc.nominal_length = arc.path.length + arc.lead;
    arc.tolerance = after.tolerance;
    arc.feed = std::max(limited_feed(before, 1), limited_feed(after, 1));
    arc.max_speed = speed;
    arc.max_acceleration = corner.limits.acceleration;
    arc.end = SegmentEnd::tangent;
    arc.cycle = period;
    arc.finish_length(period);
}

/// Places an arc of a given size in its corner. nullopt: it exceeds the tolerance or its share of a block, or is not
/// tangent.
std::optional<BlendedCorner> place_arc(const CornerSides& corner, const BlendSize& size, const Machine& machine) {
    const Side& in = corner.in;
    const Side& out = corner.out;
    const BlendSegment& before = *in.segment;
    const BlendSegment& after = *out.segment;
    const double period = machine.controller.period;
    const Vec3 centre = centre_of(in, out, corner.point, corner.binormal, size.radius, corner.limits.half_angle);
    if (!centre.allFinite()) return std::nullopt;
    const bool lines = corner.of_lines();
    if (!lines && (centre - corner.point).norm() - size.radius > corner.limits.tolerance) return std::nullopt;
    const double trim_in = lines ? size.trim : trim_of(in, corner.point, centre);
    const double trim_out = lines ? size.trim : trim_of(out, corner.point, centre);
    if (before.curved() && trim_in * before.path.rate > in.greatest_angle) return std::nullopt;
    if (after.curved() && trim_out * after.path.rate > out.greatest_angle) return std::nullopt;

    BlendedCorner blended{before, {}, after, false};
    const double left = before.length - trim_in;
    const bool short_line = left / size.speed < machine.controller.trapezoid.gap_periods * period;
    blended.consumed = !before.curved() && !before.blended_before && short_line;
    cut(blended.before, 0, left);
    cut(blended.after, trim_out, after.path.length);
    BlendSegment& arc = blended.arc;
    arc.path = arc_between(blended.before.path.end, blended.after.path.begin, centre, corner.binormal);
    if (!(arc.path.length * arc.path.rate > no_angle)) return std::nullopt;
    arc.lead = blended.consumed ? left : 0;
    finish_arc(arc, corner, size.speed, period);
    const double acceleration = corner.limits.acceleration;
    if (!meets(in, blended.before.path, arc.path, size.speed, acceleration, period) ||
        !meets(out, blended.after.path, arc.path, size.speed, acceleration, period))
        return std::nullopt;
    return blended;
}

}  // namespace

BlendSize blend_size(const BlendCorner& corner) {
    const double theta = corner.half_angle;
    const double of_tolerance = std::cos(theta) * corner.tolerance / (1 - std::sin(theta));
    const double distance = std::min({corner.length_in, corner.length_out, of_tolerance});
    const double greatest = std::tan(theta) * distance;
    BlendSize size;
    size.speed = std::min(std::sqrt(corner.normal_acceleration * greatest), corner.speed);
    // At most the length that two overlapping ramps with half of the acceleration would need on the blocks.
    const double ramp = 0.5 * corner.acceleration;
    const double time = std::min(std::sqrt(2 * ramp * distance), size.speed) / ramp;
    const double of_ramps = std::min(time * size.speed / (pi - 2 * theta), greatest);
    size.radius = std::max(size.speed * size.speed / corner.normal_acceleration, of_ramps);
    size.trim = size.radius / std::tan(theta);
    return size;
}

double least_in_plane(const Vec3& normal, const Vec3& limits) {
    constexpr double none = 1e-12;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
        least = std::min(least, limits[i] / std::max(none, std::sqrt(std::max(0.0, 1 - normal[i] * normal[i]))));
    return least;
}

std::optional<BlendedCorner> blend_corner(const BlendSegment& before, const BlendSegment& after,
                                          const Machine& machine) {
    const std::optional<CornerSides> corner = corner_of(before, after, machine);
    if (!corner) return std::nullopt;
    const BlendSize size = blend_size(corner->limits);
    const double turning = pi - 2 * corner->limits.half_angle;
    if (!(size.radius > least_radius) || !(size.radius * turning > least_arc)) return std::nullopt;
    return place_arc(*corner, size, machine);
}

}  // namespace clsurf

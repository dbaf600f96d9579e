#include "simulation/plan/blend_segment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clsurf {
namespace {

/// The greatest value along a direction for which each axis stays within its own limit.
template <typename Limit>
double along(const Vec3& direction, const Machine& machine, Limit limit) {
    double greatest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const double part = std::abs(direction[i]);
        if (part > 0) greatest = std::min(greatest, limit(machine.axes[static_cast<std::size_t>(i)]) / part);
    }
    return greatest;
}

double speed_limit(const MachineAxis& axis) { return axis.max_speed; }
double acceleration_limit(const MachineAxis& axis) { return axis.max_acceleration; }

/// Smallest radius of curvature of a spiral or helix.
double tightest_radius(const PathElement& arc, double sweep) {
    const double radius = std::min(arc.radius, arc.radius + arc.growth * sweep);
    const double squared = arc.growth * arc.growth + radius * radius;
    const double flat = squared * std::sqrt(squared) / (squared + arc.growth * arc.growth);
    const double rise = arc.rise.norm() * sweep;
    return flat + rise * rise / flat;
}

/// Limits of an arc or a helix: the lower of those in its plane, for any direction, and those along its axis.
void limit_arc(BlendSegment& segment, const Machine& machine) {
    const PathElement& arc = segment.path;
    int normal = 0;
    (void)arc.first.cross(arc.second).cwiseAbs().maxCoeff(&normal);
    const MachineAxis& a = machine.axes[static_cast<std::size_t>((normal + 1) % 3)];
    const MachineAxis& b = machine.axes[static_cast<std::size_t>((normal + 2) % 3)];
    const double sweep = segment.sweep();
    const double radius = std::min(arc.radius, arc.radius + arc.growth * sweep);
    const double acceleration = std::min({a.max_acceleration, b.max_acceleration});
    const double of_normal = std::min(normal_share * acceleration, machine.path.max_normal_acceleration);
    const double of_plane = std::min({std::sqrt(of_normal * std::hypot(radius, arc.growth)), a.max_speed, b.max_speed});
    const double in_plane = std::hypot(radius * sweep, arc.growth * sweep);
    const double distance = std::hypot(in_plane, arc.rise.norm() * sweep);
    const Vec3 chord = arc.end - arc.begin;
    double speed_time = in_plane / of_plane, acceleration_time = in_plane / acceleration;
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine.axes[static_cast<std::size_t>(i)];
        speed_time = std::max(speed_time, std::abs(chord[i]) / axis.max_speed);
        acceleration_time = std::max(acceleration_time, std::abs(chord[i]) / axis.max_acceleration);
    }
    segment.max_speed = distance / speed_time;
    segment.max_acceleration = distance / acceleration_time;
}

}  // namespace

Vec3 BlendSegment::at(double distance) const {
    if (distance < lead) return path.begin + (distance - lead) * lead_tangent;
    return path.at(std::min(distance - lead, path.length));
}

Vec3 BlendSegment::start_tangent() const { return lead > 0 ? lead_tangent : path.tangent(0).normalized(); }

Vec3 BlendSegment::end_tangent() const { return path.tangent(path.length).normalized(); }

double BlendSegment::acceleration() const {
    const double share = 1 - std::max(step_after, step_before);
    const bool overlaps = blended_before || end == SegmentEnd::parabolic;
    return max_acceleration * share * (overlaps ? 0.5 : 1.0);
}

double BlendSegment::tangential_acceleration() const {
    return curved() ? acceleration() * tangential_share : acceleration();
}

void BlendSegment::limit_speed_by_length(double shortest_time) {
    max_speed = std::min(max_speed, length / shortest_time);
}

void BlendSegment::finish_length(double period) {
    if (final_length) return;
    final_length = true;
    limit_speed_by_length(period);
    if (!curved() || blend) return;
    const double all = acceleration();
    const double radius = tightest_radius(path, sweep());
    const double asked = max_speed * max_speed / radius;
    if (asked > normal_share * all) {
        max_speed = std::sqrt(normal_share * all * radius);
        tangential_share = 0.5;
    } else {
        tangential_share = std::sqrt(1 - asked / all * (asked / all));
    }
}

BlendSegment segment_of(const PathElement& element, const Machine& machine) {
    BlendSegment segment;
    segment.path = element;
    segment.length = segment.nominal_length = element.length;
    if (element.arc) {
        limit_arc(segment, machine);
    } else {
        segment.max_speed = along(element.direction, machine, speed_limit);
        segment.max_acceleration = along(element.direction, machine, acceleration_limit);
    }
    segment.max_acceleration = std::min(segment.max_acceleration, machine.path.max_acceleration);
    segment.rapid = !std::isfinite(element.feed);
    segment.feed = std::min(element.feed, segment.max_speed);
    segment.end = element.stops ? SegmentEnd::stop : element.tolerance > 0 ? SegmentEnd::parabolic : SegmentEnd::exact;
    segment.tolerance = std::isfinite(element.tolerance) ? element.tolerance : 0;
    segment.limit_speed_by_length(machine.controller.period);
    segment.cycle = machine.controller.period;
    return segment;
}

double half_corner_angle(const Vec3& in, const Vec3& out) {
    // atan2 is accurate near both ends of the range, unlike acos.
    return std::atan2((in + out).norm(), (in - out).norm());
}

}  // namespace clsurf

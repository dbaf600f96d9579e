#pragma once
// Joints between two blocks: the change of direction, and the highest speed at a given curvature.

#include "core/geometry.h"
#include "machine/machine.h"

namespace clsurf {

/// Deflection between unit directions [rad]: 0 straight on, π reversal. Uses atan2, which is accurate near both ends of the
/// range, unlike acos.
[[nodiscard]] double deflection(const Vec3& in, const Vec3& out);

/// The speed at which the distance between an arc and the chord of one period is `error` [mm/s] (Li et al. 2025, Eq. 8; for
/// radius ≤ error a period is half a turn).
[[nodiscard]] double chord_speed(double radius, double error, double period);

/// The speed at which an arc requires the full normal acceleration, √(a r) [mm/s].
[[nodiscard]] double arc_speed(double radius, double normal_acceleration);

/// The speed at which an arc requires the jerk v³/r² [mm/s].
[[nodiscard]] double jerk_speed(double radius, double jerk);

/// No axis has a jerk limit.
[[nodiscard]] bool only_path_jerk(const Machine& machine);

/// Arcs replace corners. If an axis has a jerk limit, the machine must also give a time for the steps of its acceleration.
[[nodiscard]] bool drives_arcs(const Machine& machine);

/// Whether the jerk limit of the path also applies on bends: no axis has a jerk limit, and corners are not replaced by
/// arcs, at whose ends no jerk limit can be satisfied.
[[nodiscard]] bool limits_jerk_in_bends(const Machine& machine);

/// Whether no axis has a jerk limit and the acceleration may reverse within a period, so that points could not show the
/// limit of the path.
[[nodiscard]] bool jerks_freely(const Machine& machine);

/// The speed at which one period is as long as the chord of an arc of radius r that turns by `turning`, 2 r sin(α/2)/T
/// [mm/s]: at least one point is on the arc (Li et al. 2025, Eq. 7).
[[nodiscard]] double period_speed(double radius, double turning, double period);

/// The speed at which a corner is passed without rounding [mm/s]; `turn`: the direction after the corner minus the
/// direction before it, unit vectors. The lowest speed of the machine's rules:
/// - junction deviation: √(a r) of the arc that is tangent to both directions and leaves the corner by δ,
///   r = δ cos(α/2)/(1 − cos(α/2)) with the deflection α; a: the normal acceleration of the path, or the largest
///   along `turn` that every axis has.
/// - speed step: no axis speed changes by more.
/// Infinite if the path continues straight.
[[nodiscard]] double junction_speed(const Vec3& turn, const Machine& machine);

}  // namespace clsurf

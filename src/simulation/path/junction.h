#pragma once
// Joints between two blocks: the change of direction, and the highest speed at a given curvature.

#include "core/geometry.h"
#include "machine/machine.h"

namespace clsurf {

/// Deflection between unit directions [rad]: 0 straight on, π reversal. By atan2, which is good
/// near both ends, where acos is not.
[[nodiscard]] double deflection(const Vec3& in, const Vec3& out);

/// The speed at which the chord of one period leaves an arc by `error` [mm/s]
/// (Li et al. 2025, Eq. 8; for radius ≤ error: a period is half a turn).
[[nodiscard]] double chord_speed(double radius, double error, double period);

/// The speed at which an arc takes the whole normal acceleration, √(a r) [mm/s].
[[nodiscard]] double arc_speed(double radius, double normal_acceleration);

/// The speed at which an arc takes a jerk v³/r² [mm/s].
[[nodiscard]] double jerk_speed(double radius, double jerk);

/// No axis has a jerk limit.
[[nodiscard]] bool only_path_jerk(const Machine& machine);

/// Arcs take the place of corners. Where an axis has a jerk limit, the steps of its acceleration need a time.
[[nodiscard]] bool drives_arcs(const Machine& machine);

/// The jerk limit of the path counts in bends, too: no axis has one, and corners are not arcs, whose ends no such limit
/// holds at.
[[nodiscard]] bool limits_jerk_in_bends(const Machine& machine);

/// No axis has a jerk limit, and that of the path lets the acceleration turn round within a period, so that
/// points could not show it.
[[nodiscard]] bool jerks_freely(const Machine& machine);

/// The speed at which one period is as long as the chord of an arc of radius r that turns by `turning`,
/// 2 r sin(α/2)/T [mm/s]: at least one point lies on it (Li et al. 2025, Eq. 7).
[[nodiscard]] double period_speed(double radius, double turning, double period);

/// The speed at which a corner is passed without rounding [mm/s]; `turn`: the direction after it less the one before,
/// unit vectors. The lowest of the machine's rules:
/// - junction deviation: √(a r) of the arc that is tangent to both directions and leaves the corner by δ,
///   r = δ cos(α/2)/(1 − cos(α/2)) with the deflection α; a: the normal acceleration of the path, or the largest
///   along `turn` that every axis has.
/// - speed step: no axis speed changes by more.
/// Infinite where the path goes straight on.
[[nodiscard]] double junction_speed(const Vec3& turn, const Machine& machine);

}  // namespace clsurf

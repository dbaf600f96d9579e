#pragma once
// Kinematics of machines with two rotary axes: from axis positions to the tool's tip and direction in
// the workpiece, and back. One table of chains, by the part that carries each rotary axis:
//
//     table-table   q = m + T(−θ) ( d + R(−φ) (p − o) ) + L k
//     head-head     q = p + R(φ) ( b + T(θ) L k )
//     table-head    q = o + R(−φ) (p − o) + T(θ) L k
//
// q axis positions, p tip, k tool axis with both angles zero; T turns about the tilt axis by θ, R about
// the rotation axis by φ. In all three the tool axis in the workpiece is t = R(φ) T(θ) k. Angles are
// positive for the motion of the tool relative to the workpiece; a machine that counts in the other direction
// has a sign of −1, which is applied only on input and output of angles.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/units.h"

namespace clsurf {

enum class KinematicsType : std::uint8_t { xyz, table_table, head_head, table_head };

/// The name in a machine file: "xyz", "table-table", …
[[nodiscard]] std::string_view name_of(KinematicsType type);
[[nodiscard]] std::span<const KinematicsType> kinematics_types();

/// How the controller interpolates the tool axis from block to block (simulation/path/tool_axis_path.h).
enum class ToolAxisInterpolation : std::uint8_t {
    linear,  ///< angles proportional to the arc length
    vector,  ///< along the great circle
    safe,    ///< likewise, but not near the pole
};
[[nodiscard]] std::string_view name_of(ToolAxisInterpolation interpolation);

/// Rotates `v` about the unit vector `axis` by an angle with the given sine and cosine (Rodrigues).
[[nodiscard]] inline Vec3 turned(const Vec3& v, const Vec3& axis, double sine, double cosine) {
    return cosine * v + sine * axis.cross(v) + (1 - cosine) * axis.dot(v) * axis;
}

struct RotaryAxis {
    char letter = 'a';
    Vec3 direction = Vec3::UnitX();  ///< unit, with both angles zero
    double sign = 1;                 ///< +1 or −1: angle here = sign · angle of the control
};

/// Angles of tilt and rotation axis [rad], signs applied.
struct RotaryAngles {
    double tilt = 0, rotation = 0;
};

struct ToolPose {
    Vec3 tip = Vec3::Zero();    ///< [mm]
    Vec3 axis = Vec3::UnitZ();  ///< unit, from the tip to the spindle
};

/// Distances of the tip from the axes of rotation [mm]: its displacement per radian of a small rotation.
struct LeverArms {
    double tilt = 0, rotation = 0;
};

struct Kinematics {
    KinematicsType type = KinematicsType::xyz;
    RotaryAxis tilt{'a', Vec3::UnitX(), 1};
    RotaryAxis rotation{'c', Vec3::UnitZ(), 1};
    Vec3 tool_axis = Vec3::UnitZ();          ///< k
    Vec3 rotation_centre = Vec3::Zero();     ///< o [mm]
    Vec3 centre_from_tilt = Vec3::Zero();    ///< d [mm]
    Vec3 tilt_point = Vec3::Zero();          ///< m [mm]
    Vec3 tilt_from_rotation = Vec3::Zero();  ///< b [mm]
    double tool_length = 0;                  ///< L, from the tip to the point at q [mm]
    bool always_tool_centre_point = false;   ///< programs have no word for it: positions are always tips

    ToolAxisInterpolation interpolation = ToolAxisInterpolation::linear;
    double axis_tolerance = 0.1 * rad_per_deg;  ///< angle by which `safe` may leave the great circle [rad]

    [[nodiscard]] bool has_rotary() const { return type != KinematicsType::xyz; }

    /// The angles of both axes from A, B, C of a program [rad]; an axis that is not programmed (NaN) is at 0.
    [[nodiscard]] RotaryAngles angles_of(const Vec3& abc) const;
    /// A, B, C of a program; an axis that the machine does not have is at 0.
    [[nodiscard]] Vec3 programmed(const RotaryAngles& angles) const;
    /// Tip and tool axis in the workpiece. Defined for all angles.
    [[nodiscard]] ToolPose to_workpiece(const Vec3& linear, const RotaryAngles& angles) const;
    [[nodiscard]] LeverArms lever_arms(const Vec3& linear, const RotaryAngles& angles) const;
    /// Positions of the linear axes for a tip and the angles: the inverse of to_workpiece().tip.
    [[nodiscard]] Vec3 to_axes(const Vec3& tip, const RotaryAngles& angles) const;
    /// t = R(φ) T(θ) k.
    [[nodiscard]] Vec3 axis_of(const RotaryAngles& angles) const;
    /// Axis positions for a tip in the origin with both angles zero [mm].
    [[nodiscard]] Vec3 zero_position() const { return to_axes(Vec3::Zero(), {}); }
};

/// The angles for a tool axis: two solutions, the one with the greater tilt first; one solution if they coincide or at
/// the pole; none if the axis is out of reach (an inclined tilt axis).
struct RotarySolutions {
    std::array<RotaryAngles, 2> angles;
    int count = 0;
    bool pole = false;  ///< the tool axis is along the rotation axis: any rotation is a solution
};

/// A tool axis nearer to the rotation axis (sine of the angle) is at the pole.
inline constexpr double pole_sine = 1e-9;

/// Solves R(φ) T(θ) k = `axis` (unit); at the pole the rotation is `before.rotation`. Angles in (−π, π]. For two
/// intersecting axes: Paden, Kahan 1986, subproblem 2.
[[nodiscard]] RotarySolutions solve_rotary(const Kinematics& kinematics, const Vec3& axis, const RotaryAngles& before);

/// The range of an angle [rad].
struct AngleRange {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool contains(double angle) const { return angle >= low && angle <= high; }
};

/// The angles for a series of tool axes with the least total travel |Δθ| + |Δφ| over both solutions at each (dynamic
/// programming), so that a cut does not change between solutions unnecessarily. Starts from `before`. If the result
/// is shorter than `axes`, the next axis is out of reach. O(axes).
[[nodiscard]] std::vector<RotaryAngles> follow_rotary(const Kinematics& kinematics, std::span<const Vec3> axes,
                                                      const RotaryAngles& before, const AngleRange& tilt,
                                                      const AngleRange& rotation);

}  // namespace clsurf

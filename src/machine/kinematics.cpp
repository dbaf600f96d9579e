#include "machine/kinematics.h"

#include <cmath>
#include <numbers>

namespace clsurf {
namespace {

constexpr std::array<KinematicsType, 4> all_types{KinematicsType::xyz, KinematicsType::table_table,
                                                  KinematicsType::head_head, KinematicsType::table_head};
constexpr double full_turn = 2 * std::numbers::pi;

Vec3 turned_by(const Vec3& v, const RotaryAxis& axis, double angle) {
    return turned(v, axis.direction, std::sin(angle), std::cos(angle));
}

/// The angle about `axis` that takes a to b, both with equal components along it.
double angle_about(const Vec3& axis, const Vec3& a, const Vec3& b) {
    // The perpendicular components first: near the axis the components along it would dominate.
    const Vec3 across_a = a - axis.dot(a) * axis;
    const Vec3 across_b = b - axis.dot(b) * axis;
    return std::atan2(axis.dot(across_a.cross(across_b)), across_a.dot(across_b));
}

/// Shifts `angle` by whole turns to the value inside the range that is nearest to `before`. False if there is no such value.
bool wrap_near(double& angle, double before, const AngleRange& range) {
    double wrapped = angle + full_turn * std::round((before - angle) / full_turn);
    if (wrapped > range.high) wrapped -= full_turn * std::ceil((wrapped - range.high) / full_turn);
    if (wrapped < range.low) wrapped += full_turn * std::ceil((range.low - wrapped) / full_turn);
    if (!range.contains(wrapped)) return false;
    angle = wrapped;
    return true;
}

double travel_between(const RotaryAngles& a, const RotaryAngles& b) {
    return std::abs(a.tilt - b.tilt) + std::abs(a.rotation - b.rotation);
}

}  // namespace

std::string_view name_of(KinematicsType type) {
    constexpr std::array<std::string_view, 4> names{"xyz", "table-table", "head-head", "table-head"};
    return names[static_cast<std::size_t>(type)];
}

std::string_view name_of(ToolAxisInterpolation interpolation) {
    constexpr std::array<std::string_view, 3> names{"linear", "vector", "safe"};
    return names[static_cast<std::size_t>(interpolation)];
}

std::span<const KinematicsType> kinematics_types() { return all_types; }

RotaryAngles Kinematics::angles_of(const Vec3& abc) const {
    const auto angle = [&](const RotaryAxis& axis) {
        const double value = abc[axis.letter - 'a'];
        return value == value ? axis.sign * value : 0.0;
    };
    return {angle(tilt), angle(rotation)};
}

Vec3 Kinematics::programmed(const RotaryAngles& angles) const {
    Vec3 abc = Vec3::Zero();
    abc[tilt.letter - 'a'] = tilt.sign * angles.tilt;
    abc[rotation.letter - 'a'] = rotation.sign * angles.rotation;
    return abc;
}

Vec3 Kinematics::axis_of(const RotaryAngles& angles) const {
    return turned_by(turned_by(tool_axis, tilt, angles.tilt), rotation, angles.rotation);
}

ToolPose Kinematics::to_workpiece(const Vec3& linear, const RotaryAngles& angles) const {
    const Vec3 tool = tool_length * tool_axis;
    switch (type) {
        case KinematicsType::xyz: return {linear, tool_axis};
        case KinematicsType::table_table: {
            const Vec3 from_centre = turned_by(linear - tool - tilt_point, tilt, angles.tilt) - centre_from_tilt;
            return {turned_by(from_centre, rotation, angles.rotation) + rotation_centre, axis_of(angles)};
        }
        case KinematicsType::head_head:
            return {
                linear - turned_by(tilt_from_rotation + turned_by(tool, tilt, angles.tilt), rotation, angles.rotation),
                axis_of(angles)};
        case KinematicsType::table_head: {
            const Vec3 from_centre = linear - turned_by(tool, tilt, angles.tilt) - rotation_centre;
            return {turned_by(from_centre, rotation, angles.rotation) + rotation_centre, axis_of(angles)};
        }
    }
    return {};
}

LeverArms Kinematics::lever_arms(const Vec3& linear, const RotaryAngles& angles) const {
    const Vec3 tool = tool_length * tool_axis;
    const auto arm = [](const RotaryAxis& axis, const Vec3& from_axis) {
        return axis.direction.cross(from_axis).norm();
    };
    switch (type) {
        case KinematicsType::xyz: break;
        case KinematicsType::table_table: {
            const Vec3 from_tilt = linear - tool - tilt_point;
            return {arm(tilt, from_tilt), arm(rotation, turned_by(from_tilt, tilt, angles.tilt) - centre_from_tilt)};
        }
        case KinematicsType::head_head:
            return {arm(tilt, tool), arm(rotation, tilt_from_rotation + turned_by(tool, tilt, angles.tilt))};
        case KinematicsType::table_head:
            return {arm(tilt, tool), arm(rotation, linear - turned_by(tool, tilt, angles.tilt) - rotation_centre)};
    }
    return {};
}

Vec3 Kinematics::to_axes(const Vec3& tip, const RotaryAngles& angles) const {
    const Vec3 tool = tool_length * tool_axis;
    switch (type) {
        case KinematicsType::xyz: break;
        case KinematicsType::table_table: {
            const Vec3 from_tilt = centre_from_tilt + turned_by(tip - rotation_centre, rotation, -angles.rotation);
            return tilt_point + turned_by(from_tilt, tilt, -angles.tilt) + tool;
        }
        case KinematicsType::head_head:
            return tip + turned_by(tilt_from_rotation + turned_by(tool, tilt, angles.tilt), rotation, angles.rotation);
        case KinematicsType::table_head:
            return rotation_centre + turned_by(tip - rotation_centre, rotation, -angles.rotation) +
                   turned_by(tool, tilt, angles.tilt);
    }
    return tip;
}

RotarySolutions solve_rotary(const Kinematics& kinematics, const Vec3& axis, const RotaryAngles& before) {
    const Vec3& e1 = kinematics.tilt.direction;
    const Vec3& e2 = kinematics.rotation.direction;
    const Vec3& k = kinematics.tool_axis;
    RotarySolutions solutions;
    // z = T(θ) k = R(−φ) t in the basis e2, e1, e2 × e1: its components along e1 and e2 are known, its component
    // perpendicular to e2 is as long as that of t. (The cross product is accurate near the pole; 1 − cos² is
    // not.)
    const Vec3 normal = e2.cross(e1);
    const double s2 = normal.squaredNorm();
    const double c = e1.dot(e2);
    const double across = e2.cross(axis).squaredNorm();
    const double along_e1 = (e1.dot(k) - c * e2.dot(axis)) / s2;
    const double along_e2 = (e2.dot(axis) - c * e1.dot(k)) / s2;
    const double square = across / s2 - along_e1 * along_e1;
    constexpr double rounding = 1e-14;
    if (square < -rounding) return solutions;  // out of reach
    solutions.pole = across < pole_sine * pole_sine;
    const double side = std::sqrt(std::max(0.0, square));
    const bool one = solutions.pole || side < pole_sine;
    solutions.count = one ? 1 : 2;
    for (int i = 0; i < solutions.count; ++i) {
        const Vec3 z = along_e1 * e1 + along_e2 * e2 + (i == 0 ? side : -side) * normal;
        RotaryAngles& found = solutions.angles[static_cast<std::size_t>(i)];
        found.tilt = angle_about(e1, k, z);
        found.rotation = solutions.pole ? before.rotation : angle_about(e2, z, axis);
    }
    if (!one && solutions.angles[0].tilt < solutions.angles[1].tilt)
        std::swap(solutions.angles[0], solutions.angles[1]);
    return solutions;
}

std::vector<RotaryAngles> follow_rotary(const Kinematics& kinematics, std::span<const Vec3> axes,
                                        const RotaryAngles& before, const AngleRange& tilt,
                                        const AngleRange& rotation) {
    struct State {
        RotaryAngles angles;
        double travel = std::numeric_limits<double>::infinity();
        int from = 0;
    };
    std::vector<std::array<State, 2>> states(axes.size());
    std::array<State, 2> last{State{before, 0, 0}, State{}};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        for (int from = 0; from < 2; ++from) {
            const State& origin = last[static_cast<std::size_t>(from)];
            if (!std::isfinite(origin.travel)) continue;
            const RotarySolutions solutions = solve_rotary(kinematics, axes[i], origin.angles);
            for (int s = 0; s < solutions.count; ++s) {
                RotaryAngles angles = solutions.angles[static_cast<std::size_t>(s)];
                if (!wrap_near(angles.tilt, origin.angles.tilt, tilt) ||
                    !wrap_near(angles.rotation, origin.angles.rotation, rotation))
                    continue;
                const double travel = origin.travel + travel_between(angles, origin.angles);
                // At the pole both branches continue, each with its own rotation.
                State& state = states[i][static_cast<std::size_t>(solutions.count == 1 ? from : s)];
                if (travel < state.travel) state = {angles, travel, from};
            }
        }
        if (!std::isfinite(states[i][0].travel) && !std::isfinite(states[i][1].travel)) {
            states.resize(i);
            break;
        }
        last = states[i];
    }
    std::vector<RotaryAngles> path(states.size());
    auto branch = static_cast<std::size_t>(last[1].travel < last[0].travel ? 1 : 0);
    for (std::size_t i = path.size(); i-- > 0;) {
        path[i] = states[i][branch].angles;
        branch = static_cast<std::size_t>(states[i][branch].from);
    }
    return path;
}

}  // namespace clsurf

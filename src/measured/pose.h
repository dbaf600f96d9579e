#pragma once
// Pose: position and orientation of the axes of a measurement on the part.

#include <algorithm>
#include <cmath>

#include "core/geometry.h"

namespace clsurf {

/// place = turn · point + shift [mm].
struct Pose {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a rotation
    Vec3 shift = Vec3::Zero();

    [[nodiscard]] Vec3 operator()(const Vec3& point) const { return turn * point + shift; }
    /// Rotated by `rotation` (its length is the angle [rad]) about `centre`, then shifted.
    [[nodiscard]] Pose moved(const Vec3& by, const Vec3& rotation, const Vec3& centre) const {
        const double angle = rotation.norm();
        const Vec3 axis = angle > 0 ? Vec3(rotation / angle) : Vec3(Vec3::UnitZ());
        const Eigen::Matrix3d r = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
        return {r * turn, r * (shift - centre) + centre + by};
    }
};

/// Angles [rad] about X, Y and Z with turn = Rz(c) · Ry(b) · Rx(a).
[[nodiscard]] inline Vec3 turns_of(const Eigen::Matrix3d& turn) {
    return {std::atan2(turn(2, 1), turn(2, 2)), std::asin(std::clamp(-turn(2, 0), -1.0, 1.0)),
            std::atan2(turn(1, 0), turn(0, 0))};
}

}  // namespace clsurf

#pragma once
// Vectors, boxes and frames as Eigen types. Lengths in mm, directions without unit.

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace clsurf {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;

/// Angle of a direction against the first axis, -π … π [rad].
inline double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

/// The angle between two vectors [rad], 0 … π; atan2 keeps it accurate near 0.
inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Three doubles without Eigen's machinery, for columns (trivially copyable).
struct Xyz {
    double x = 0, y = 0, z = 0;
    Xyz() = default;
    Xyz(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    explicit Xyz(const Vec3& v) : x(v.x()), y(v.y()), z(v.z()) {}
    [[nodiscard]] Vec3 vec() const { return {x, y, z}; }
    friend bool operator==(const Xyz&, const Xyz&) = default;
};

}  // namespace clsurf

#pragma once
// ToolAxisPath: the motion of the tool axis from one direction to the next within a block, as angles of the
// rotary axes.
//
// linear: both angles are proportional to arc length; the axis leaves the plane of its two ends. vector: along
// the great circle between them; near the pole the axis of rotation becomes very fast, with a peak of 1/sin A
// per angle of the tool, where A is the smallest angle from the pole. safe: along the great circle, except
// near the pole. There the tilting axis continues to the other side if the tolerance permits the deviation, or
// the rotation follows an odd cubic that its axis can run.

#include <span>

#include "machine/kinematics.h"

namespace clsurf {

/// A passage of the pole with limited speed of the rotation, around the point nearest to it: |s| < half
/// of angle s along the great circle. C(s) = slope s + cubic s³.
struct PoleWindow {
    double half = 0;  ///< [rad]; 0: none is needed
    double slope = 0, cubic = 0;
    double greatest_speed = 0;  ///< |dC/ds|
    double greatest_bend = 0;   ///< |d²C/ds²|
};

/// The narrowest window whose dC/ds stays within `ratio`, the greatest speed of the rotation over that of
/// the tool axis; `least_tilt` > 0 [rad] at the nearest point. By bisection.
[[nodiscard]] PoleWindow pole_window(double least_tilt, double ratio);

/// The point at `part` (0 … 1) of the great circle from a to b, unit vectors.
[[nodiscard]] Vec3 great_circle(const Vec3& a, const Vec3& b, double part);

class ToolAxisPath {
public:
    ToolAxisPath() = default;
    /// `to`: the angles programmed; on great circles the axis is what counts of them. `ratio`: as above;
    /// `tolerance` [rad]: of safe. Opposite axes span no plane, and from the pole
    /// the rotation is free: linear.
    ToolAxisPath(const Kinematics& kinematics, const RotaryAngles& from, const RotaryAngles& to, const AngleRange& tilt,
                 double ratio, double tolerance);

    [[nodiscard]] RotaryAngles at(double part) const;
    /// Greatest angle between the axis and the great circle at the same part, over `samples` places [rad].
    [[nodiscard]] double greatest_error(int samples) const;

private:
    enum class Mode : unsigned char { linear, great_circle, window };
    [[nodiscard]] RotaryAngles on_great_circle(const Vec3& axis) const;

    const Kinematics* kinematics_ = nullptr;
    Mode mode_ = Mode::linear;
    RotaryAngles from_, to_;
    Vec3 begin_ = Vec3::UnitZ(), end_ = Vec3::UnitZ();
    double angle_ = 0;    ///< between the two axes [rad]
    double branch_ = 1;   ///< sign of the tilt
    double nearest_ = 0;  ///< angle along the great circle to the point nearest to the pole
    double turning_ = 1;  ///< +1: the rotation grows
    double centre_ = 0;   ///< of the rotation in the window
    PoleWindow window_;
};

}  // namespace clsurf

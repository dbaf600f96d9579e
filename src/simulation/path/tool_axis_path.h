#pragma once
// ToolAxisPath: the motion of the tool axis from one direction to the next within a block, as angles of the
// rotary axes.
//
// linear: both angles are proportional to arc length; the axis leaves the plane of its two end directions. vector: along
// the great circle between them; near the pole the rotation becomes very fast, with a peak of 1/sin A per angle of the
// tool, where A is the smallest angle to the pole. safe: along the great circle, except near the pole. There the tilting
// axis continues to the other side if the tolerance permits the deviation; if not, the rotation follows an odd cubic that
// its axis can run.

#include <span>

#include "machine/kinematics.h"

namespace clsurf {

/// A passage near the pole with limited speed of the rotation, around the point nearest to the pole: |s| < half, with the
/// angle s along the great circle. C(s) = slope s + cubic s³.
struct PoleWindow {
    double half = 0;  ///< [rad]; 0: no window is needed
    double slope = 0, cubic = 0;
    double greatest_speed = 0;  ///< |dC/ds|
    double greatest_bend = 0;   ///< |d²C/ds²|
};

/// The narrowest window in which dC/ds stays within `ratio`, the greatest speed of the rotation divided by that of the tool
/// axis; `least_tilt` > 0: at the nearest point [rad]. By bisection.
[[nodiscard]] PoleWindow pole_window(double least_tilt, double ratio);

/// The point at `part` (0 … 1) of the great circle from a to b, unit vectors.
[[nodiscard]] Vec3 great_circle(const Vec3& a, const Vec3& b, double part);

class ToolAxisPath {
public:
    ToolAxisPath() = default;
    /// `to`: the programmed angles; on great circles only the axis direction that they give counts. `ratio`: as for
    /// pole_window(); `tolerance`: of mode safe [rad]. Linear if the axes are opposite, so that they define no plane, or if
    /// the path begins at the pole, where the rotation is free.
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
    double turning_ = 1;  ///< +1: the rotation angle increases
    double centre_ = 0;   ///< of the rotation in the window
    PoleWindow window_;
};

}  // namespace clsurf

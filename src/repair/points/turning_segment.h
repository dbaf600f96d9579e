#pragma once
// TurningSegment: the tool axis along the old lines of a section, the tool axis for new lines, and the angle
// between both.

#include "repair/line_edit.h"
#include "repair/points/orientation.h"
#include "repair/points/smooth_segment.h"

namespace clsurf {

/// A place of a new line.
struct NewPlace {
    double arc_length = 0;         ///< [mm] along the old lines
    Vec3 position = Vec3::Zero();  ///< [mm]
    bool fixed = false;            ///< as AlignedPoint::fixed
};

/// The largest angle between the tool axis on a new line and on the old ones.
struct AxisError {
    double greatest = 0;    ///< [rad]
    std::size_t point = 0;  ///< the old point between its ends where it is greatest; 0: there is none
};

class TurningSegment {
public:
    /// Old lines and orientation must outlive it. The lines of the section may be divided. O(points).
    TurningSegment(const OldSegment& old, const Orientation& orientation,
                   const std::vector<AlignedPoint>& aligned_points, const LineRules& rules);
    TurningSegment(const TurningSegment&) = delete;
    TurningSegment& operator=(const TurningSegment&) = delete;

    /// Angles of a new line at one of its ends: the smoothest path of the angles in a tube, at the projection onto the old
    /// lines; at an old point, its own angles.
    [[nodiscard]] RotaryAngles angles(const NewPlace& place) const;
    /// The words for these angles; at an old point they are unchanged.
    [[nodiscard]] LineAngles words(const NewPlace& place) const;
    /// The axis along a new line compared with the axis at the same fraction of the old lines between its ends, at old
    /// points and half-way between them. O(old points between).
    [[nodiscard]] AxisError error_of(const NewPlace& from, const NewPlace& to) const;

private:
    [[nodiscard]] RotaryAngles at(double arc_length) const;
    /// The old point at a place; 0: none.
    [[nodiscard]] std::size_t old_point(const NewPlace& place) const;

    const OldSegment& old_;
    const Orientation& orientation_;
    double turn_lever_;   ///< [mm/rad] scale of rotations in `drawn_`
    OldSegment drawn_;    ///< the angles as lines in space: tilt, rotation, arc length [mm]
    SmoothCurve smooth_;  ///< through them
};

}  // namespace clsurf

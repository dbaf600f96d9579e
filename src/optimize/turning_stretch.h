#pragma once
// TurningStretch: where the tool points along the old lines of a stretch, and how far new lines beside them turn it away.

#include "optimize/line_edit.h"
#include "optimize/old_stretch.h"
#include "optimize/orientation.h"

namespace clsurf {

/// A place of a new line.
struct NewPlace {
    double way = 0;                ///< [mm] along the old lines
    Vec3 position = Vec3::Zero();  ///< [mm]
};

/// How far a new line turns the tool axis away from the old ones.
struct AxisError {
    double greatest = 0;    ///< [rad]
    std::size_t point = 0;  ///< the old point between its ends where it is greatest; 0: there is none
};

class TurningStretch {
public:
    /// Both must outlive it. The lines of the stretch may be divided.
    TurningStretch(const OldStretch& old, const Orientation& orientation) : old_(old), orientation_(orientation) {}

    /// Angles of the old lines at the foot of a new point on them.
    [[nodiscard]] RotaryAngles beside(const NewPlace& place) const;
    /// The words for them: those of an old point as they stand where the place is its own.
    [[nodiscard]] LineAngles words(const NewPlace& place) const;
    /// The axis along a new line against that at the same part of the old ones between its ends, at old points and half-way
    /// between them. O(old points between).
    [[nodiscard]] AxisError error_of(const NewPlace& from, const NewPlace& to) const;

private:
    [[nodiscard]] RotaryAngles at(double way) const;

    const OldStretch& old_;
    const Orientation& orientation_;
};

}  // namespace clsurf

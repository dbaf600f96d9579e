#pragma once
// Arcs that blend two blocks of the trapezoidal planner: tangent to both, inside the tolerance, over at most half of
// each, and no larger than the speed that the blocks reach can use.

#include <optional>

#include "simulation/plan/blend_segment.h"

namespace clsurf {

/// What is known of a corner before its arc.
struct BlendCorner {
    double half_angle = 0;                 ///< of the corner, half_corner_angle() [rad]
    double tolerance = 0;                  ///< distance of the arc from the corner [mm]
    double length_in = 0, length_out = 0;  ///< that the arc may take from the blocks [mm]
    double acceleration = 0;               ///< in the plane of the corner, in any direction [mm/s²]
    double normal_acceleration = 0;        ///< [mm/s²]
    double speed = 0;                      ///< that the blocks can ask for [mm/s]
};

struct BlendSize {
    double radius = 0, trim = 0;  ///< [mm]; the second: from the corner to the arc
    double speed = 0;             ///< that the arc allows [mm/s]
};

/// The arc of a corner between lines.
[[nodiscard]] BlendSize blend_size(const BlendCorner& corner);

/// The greatest value in every direction of a plane, from those of the axes: an axis with the angle β to the
/// plane sees cos β of it. `normal`: unit.
[[nodiscard]] double least_in_plane(const Vec3& normal, const Vec3& limits);

/// Two blocks and the arc between them.
struct BlendedCorner {
    BlendSegment before, arc, after;
    bool consumed = false;  ///< the first block has become a part of the arc
};

/// The arc of a corner; none: the corner has none inside its limits. The arc's speed and acceleration are set, no ends.
[[nodiscard]] std::optional<BlendedCorner> blend_corner(const BlendSegment& before, const BlendSegment& after,
                                                        const Machine& machine);

}  // namespace clsurf

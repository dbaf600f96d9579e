#pragma once
// Arcs that blend two blocks of the trapezoidal planner. An arc is tangent to both blocks, stays within the tolerance and
// replaces at most half of each block. It is not larger than the highest speed of the blocks requires.

#include <optional>

#include "simulation/plan/blend_segment.h"

namespace clsurf {

/// The data of a corner from which its arc is computed.
struct BlendCorner {
    double half_angle = 0;                 ///< half_corner_angle() [rad]
    double tolerance = 0;                  ///< greatest distance of the arc from the corner [mm]
    double length_in = 0, length_out = 0;  ///< lengths of the blocks that the arc may replace [mm]
    double acceleration = 0;               ///< limit in the plane of the corner, in any direction [mm/s²]
    double normal_acceleration = 0;        ///< [mm/s²]
    double speed = 0;                      ///< highest speed that the blocks can reach [mm/s]
};

struct BlendSize {
    double radius = 0, trim = 0;  ///< [mm]; trim: from the corner to the start of the arc
    double speed = 0;             ///< greatest speed on the arc [mm/s]
};

/// The arc of a corner between lines.
[[nodiscard]] BlendSize blend_size(const BlendCorner& corner);

/// The greatest value that is permitted in every direction of a plane, from the limits of the axes. An axis at the angle β
/// to the plane takes part with cos β. `normal`: unit vector.
[[nodiscard]] double least_in_plane(const Vec3& normal, const Vec3& limits);

/// Two blocks and the arc between them.
struct BlendedCorner {
    BlendSegment before, arc, after;
    bool consumed = false;  ///< the arc replaces the rest of the first block
};

/// The arc of a corner; nullopt if no arc satisfies the limits. Sets speed and acceleration of the arc, not how it ends.
[[nodiscard]] std::optional<BlendedCorner> blend_corner(const BlendSegment& before, const BlendSegment& after,
                                                        const Machine& machine);

}  // namespace clsurf

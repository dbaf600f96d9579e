#pragma once
// PathElement: one motion of a program as a curve by its way: a line, an arc or a helix.

#include "core/geometry.h"
#include "program/motion.h"

namespace clsurf {

struct PathElement {
    bool arc = false;
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();  ///< [mm]
    Vec3 direction = Vec3::Zero();  ///< of a line, unit
    // p(θ) = centre + (radius + growth θ)(first cos θ + second sin θ) + rise θ, θ = rate · way
    Vec3 centre = Vec3::Zero(), first = Vec3::Zero(), second = Vec3::Zero(), rise = Vec3::Zero();
    double radius = 0, growth = 0, rate = 0;
    double length = 0;     ///< [mm]
    double feed = 0;       ///< asked speed [mm/s]; infinite for a rapid
    double tolerance = 0;  ///< [mm]; 0: corners are not rounded (exact path)
    LineNumber line = 0;

    [[nodiscard]] Vec3 at(double way) const;
    /// First to third derivative by the way; the first is a unit vector but for the growth of a
    /// radius (radii of start and end may differ within the reader's play).
    [[nodiscard]] Vec3 tangent(double way) const;
    [[nodiscard]] Vec3 second_derivative(double way) const;
    [[nodiscard]] Vec3 third_derivative(double way) const;
};

/// The curve of a motion between two points; length 0 where there is no way.
[[nodiscard]] PathElement element_of(MotionKind kind, const Arc* arc, const Vec3& begin, const Vec3& end);

}  // namespace clsurf

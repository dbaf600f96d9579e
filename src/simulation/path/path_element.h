#pragma once
// PathElement: one motion of a program, or a part of one, as a curve over arc length: a line, an arc, a helix,
// a cubic or a span of a spline.

#include <limits>
#include <memory>

#include "core/geometry.h"
#include "numeric/bezier_curve.h"
#include "numeric/cubic_span.h"
#include "program/motion.h"

namespace clsurf {

// As in docs/simulate.md#special-cases.
inline constexpr double straight_on = 1e-9;      ///< [rad] a smaller turn moves no axis
inline constexpr double least_bend_jump = 1e-9;  ///< [1/mm] a smaller jump of curvature is ignored
// Between spans of splines, because programs round control points.
inline constexpr double straight_on_of_splines = 1e-6;      ///< [rad]
inline constexpr double least_bend_jump_of_splines = 1e-4;  ///< [1/mm]
// Ten times the rounding of doubles at 1 km.
inline constexpr double no_arc_length = 1e-9;  ///< [mm] closer points count as one

/// Derivatives of a position by the arc length, of order 1 to 3 [-, 1/mm, 1/mm²].
struct PathDerivatives {
    Vec3 first, second, third;
};

struct PathElement {
    bool arc = false, cubic = false;
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero();  ///< [mm]
    Vec3 direction = Vec3::Zero();                  ///< of a line, unit
    // p(θ) = centre + (radius + growth θ)(first cos θ + second sin θ) + rise θ, θ = rate · arc length
    Vec3 centre = Vec3::Zero(), first = Vec3::Zero(), second = Vec3::Zero(), rise = Vec3::Zero();
    double radius = 0, growth = 0, rate = 0;
    CubicSpan curve;
    std::shared_ptr<const BezierCurve> spline;  ///< nullptr: none
    double curve_from = 0, curve_length = 0;    ///< start of the element on the curve; length of the whole curve [mm]
    double length = 0;                          ///< [mm]

    // Data of the block that the element belongs to.
    double feed = 0;               ///< programmed speed [mm/s]; infinite for a rapid
    double tolerance = 0;          ///< tolerance for rounding its ends [mm]; 0: exact path
    double merging_tolerance = 0;  ///< tolerance for merging lines before that [mm]
    bool stops = false;            ///< comes to rest at its end (exact stop)
    LineNumber line = 0;
    std::int64_t block = 0;                                           ///< number among the blocks with a length
    double block_length = 0;                                          ///< [mm]
    double deviation = 0;                                             ///< greatest deviation from the block [mm]
    double greatest_speed = std::numeric_limits<double>::infinity();  ///< speed limit from its shape [mm/s]
    double jerk_share = 1;    ///< share of the axes' jerk limits that changes of speed may use
    bool corner_arc = false;  ///< replaces a corner

    [[nodiscard]] bool straight() const { return !arc && !cubic && spline == nullptr; }
    [[nodiscard]] Vec3 at(double arc_length) const;
    /// The position, and the first derivative by the arc length. This is a unit vector unless the radius grows (radii of
    /// start and end may differ within the reader's tolerance).
    [[nodiscard]] Vec3 at(double arc_length, Vec3& tangent) const;
    [[nodiscard]] Vec3 tangent(double arc_length) const;
    [[nodiscard]] Vec3 second_derivative(double arc_length) const { return derivatives(arc_length).second; }
    [[nodiscard]] PathDerivatives derivatives(double arc_length) const;
    /// Total change of direction, summed over the element [rad].
    [[nodiscard]] double turning() const;

    /// The part between two arc lengths.
    [[nodiscard]] PathElement part(double from, double to) const;
    /// Takes the block data of another element.
    void take_block(const PathElement& other);
};

/// The curve of a motion between two points; length 0 if there is none.
[[nodiscard]] PathElement element_of(MotionKind kind, const Arc* arc, const Vec3& begin, const Vec3& end);
/// A whole span of a spline.
[[nodiscard]] PathElement element_of(std::shared_ptr<const BezierCurve> spline);
/// A whole cubic.
[[nodiscard]] PathElement element_of(const CubicSpan& curve);

}  // namespace clsurf

#pragma once
// Akima: a local interpolating spline through points in space (H. Akima, J. ACM 17 (1970) 589–602). Chord
// lengths are the knots, and the weights use the lengths of vectors, so the curve does not depend on the
// orientation of the axes.
//
// Span i runs from point i to i + 1 over a local parameter u ∈ [0, h], where h is the chord:
//   r(u) = A + B u + C u² + D u³,  A = P_i, B = s_i, C = (3 m − 2 s_i − s_{i+1})/h, D = (s_i + s_{i+1} − 2 m)/h²
// with the slope m = (P_{i+1} − P_i)/h and tangents
//   s_i = (|m_{i+1} − m_i| m_{i−1} + |m_{i−1} − m_{i−2}| m_i) / (|m_{i+1} − m_i| + |m_{i−1} − m_{i−2}|),
// where slopes beyond the ends are extrapolated linearly.
//
// A tangent depends on two points on each side. Fitting must wait for them: a span that is fitted as soon as
// its end is known has a one-sided tangent there. Forward and backward passes would then get different curves,
// which shows on adjacent passes of a zigzag.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "numeric/cubic_span.h"

namespace clsurf {

enum class AkimaTangents : unsigned char {
    plain,  ///< as Akima has them
    unit,   ///< normalised, so that u is the arc length to 1 part in 10⁴ on smooth curves
};

/// The tangent (not normalised) at a point from two slopes before and two after it, in their order.
[[nodiscard]] Vec3 akima_tangent(const Vec3& before_2, const Vec3& before_1, const Vec3& behind_1,
                                 const Vec3& behind_2);

/// All spans through points [mm]; neighbours differ. Two points: a straight line; fewer: none. Symmetric: the points
/// in reverse give the same curve. O(points).
[[nodiscard]] std::vector<CubicSpan> akima_spans(std::span<const Vec3> points,
                                                 AkimaTangents tangents = AkimaTangents::plain);

/// Akima spans one at a time while points arrive, two points behind the input, as in a controller. The result is the
/// same as that of akima_spans() for all points at once.
class AkimaStream {
public:
    using Sink = std::function<void(const CubicSpan&)>;

    explicit AkimaStream(Sink sink, AkimaTangents tangents = AkimaTangents::plain)
        : sink_(std::move(sink)), tangents_(tangents) {}

    /// `point` differs from the previous one.
    void add(const Vec3& point);
    /// No more points: gives the last spans.
    void finish();

private:
    /// A chord between two points, or one that is extrapolated beyond the ends.
    struct Segment {
        Vec3 begin = Vec3::Zero(), slope = Vec3::Zero();
        double chord = 0;
    };
    void push(const Segment& segment);
    void extrapolate_before();
    void take_tangent();

    Sink sink_;
    AkimaTangents tangents_;
    Vec3 last_ = Vec3::Zero();  ///< the last point
    std::size_t points_ = 0;
    std::array<Segment, 4> segments_;  ///< the last four: the tangent between the middle two is known
    std::size_t known_ = 0;            ///< tangents so far
    Vec3 tangent_ = Vec3::Zero();      ///< the last of them
};

}  // namespace clsurf

#pragma once
// BezierCurve: a span of a spline as a rational Bézier curve over t ∈ [0, 1],
//   C(t) = Σ B_i(t) w_i P_i / Σ B_i(t) w_i,  B_i: Bernstein polynomials of its degree
// (L. Piegl, W. Tiller, The NURBS Book, 1997, chapter 1). NURBS, polynomials and quotients of polynomials all have this
// form exactly. Arc lengths are accurate to 1 part in 10¹⁰.

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

inline constexpr int most_bezier_degree = 24;

/// A point of a curve and its derivatives by the parameter [mm].
struct CurveJet {
    Vec3 at, first, second, third;
};

class BezierCurve {
public:
    struct Nearest {
        double t = 0, distance = 0;  ///< [mm]
    };

    /// A control point times its weight, relative to an origin, and the weight.
    using Weighted = Eigen::Matrix<double, 4, 1, Eigen::DontAlign>;

    /// `points`: 2 … most_bezier_degree + 1 control points [mm]; `weights`: as many; empty: all 1. A coordinate that
    /// is unknown (NaN) is unknown in all points; then there is no length and no nearest point.
    explicit BezierCurve(std::span<const Vec3> points, std::span<const double> weights = {});
    /// Weights may be 0 or negative if the sum of all is positive on the whole curve.
    BezierCurve(const Vec3& origin, std::vector<Weighted> points);

    [[nodiscard]] int degree() const { return static_cast<int>(points_.size()) - 1; }
    [[nodiscard]] Vec3 point(std::size_t i) const { return origin_ + points_[i].head<3>() / points_[i][3]; }
    [[nodiscard]] double weight(std::size_t i) const { return points_[i][3]; }

    [[nodiscard]] Vec3 at(double t) const;
    [[nodiscard]] CurveJet jet(double t) const;
    /// If the first derivative is zero, the jet of a point next to it.
    [[nodiscard]] CurveJet moving_jet(double t) const;
    /// Unit vector; also defined if the first derivative is zero.
    [[nodiscard]] Vec3 tangent(double t) const;

    [[nodiscard]] double length() const { return knots_.back().arc_length; }  ///< [mm]
    [[nodiscard]] double arc_length_to(double t) const;                       ///< [mm]
    /// The t at this arc length from the beginning [mm], clipped to [0, 1].
    [[nodiscard]] double at_arc_length(double arc_length) const;
    /// The first section of this arc length [mm] inside the curve over which the direction turns by more than 90°, for
    /// example at a cusp: its first and last t; nullopt if there is none.
    [[nodiscard]] std::optional<std::pair<double, double>> sharp_turn(double within) const;
    /// The parts up to t and from t on.
    [[nodiscard]] std::pair<BezierCurve, BezierCurve> split_at(double t) const;
    /// The total turn of the direction [rad].
    [[nodiscard]] double turning() const;

    /// The nearest point at or after `from`.
    [[nodiscard]] Nearest nearest(const Vec3& p, double from = 0) const;
    /// Ends of chords that stay within `error` [mm] of the curve; the last one is 1.
    [[nodiscard]] std::vector<double> chord_ends(double error) const;

    /// Whether it has the same control points, within `tolerance` [mm], and weights, within 10⁻⁹.
    [[nodiscard]] bool same_as(const BezierCurve& other, double tolerance) const;
    /// Replaces unknown coordinates by those of `rest`.
    [[nodiscard]] BezierCurve with_unknown_at(const Vec3& rest) const;
    /// The image of the curve under an affine map.
    [[nodiscard]] BezierCurve mapped(const std::function<Vec3(const Vec3&)>& map) const;

private:
    /// An entry of the table of arc lengths, at equal steps of t.
    struct Knot {
        Vec3 point;
        double arc_length;
    };
    [[nodiscard]] double gauss(double from, double to) const;
    void measure();
    [[nodiscard]] double stepped(std::size_t piece) const {
        return static_cast<double>(piece) / static_cast<double>(knots_.size() - 1);
    }

    Vec3 origin_;
    std::vector<Weighted> points_;
    std::vector<Knot> knots_;  ///< pieces + 1
};

/// A spline: its control points, their weights (empty: all 1) and its points + degree + 1 knots in non-decreasing
/// order.
struct Nurbs {
    int degree = 3;
    std::vector<Vec3> points;
    std::vector<double> weights, knots;
};

/// A span between two different knots.
struct NurbsSpan {
    std::size_t last_point = 0;  ///< last of the degree + 1 points that shape the span
    BezierCurve curve;
};

/// The spans of a spline in their order, between the knots `degree` and `points`. Bézier points are values of the
/// spline's blossom. O(spans degree³). Domain: counts as in Nurbs, non-decreasing knots.
[[nodiscard]] std::vector<NurbsSpan> spans_of(const Nurbs& nurbs);

/// Knots of a spline that begins in its first point and ends in its last, with these lengths of spans.
[[nodiscard]] std::vector<double> clamped_knots(int degree, std::span<const double> intervals);

/// A polynomial Σ aᵢ pⁱ, or a quotient if there is a `denominator` (b₀ = 1), over p ∈ [0, interval]. `coefficients`:
/// of p⁰, p¹ …; degree = the larger count − 1.
[[nodiscard]] BezierCurve bezier_of(std::span<const Vec3> coefficients, std::span<const double> denominator,
                                    double interval);

}  // namespace clsurf

// Rational Bézier curves: shapes with known properties, and general properties.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "numeric/bezier_curve.h"

namespace clsurf::bezier_curve_test {
namespace {

/// A quarter of a circle of radius 10 about the origin.
BezierCurve quarter() {
    const std::vector<Vec3> points{{10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    return BezierCurve(points, std::vector<double>{1, std::numbers::sqrt2 / 2, 1});
}

BezierCurve random_curve(std::mt19937& random) {
    std::uniform_real_distribution<double> place(-20, 20), weight(0.3, 4);
    std::vector<Vec3> points;
    std::vector<double> weights;
    const std::size_t count = 2 + random() % 5;
    for (std::size_t i = 0; i < count; ++i) {
        points.emplace_back(place(random), place(random), place(random));
        weights.push_back(weight(random));
    }
    return random() % 2 == 0 ? BezierCurve(points, weights) : BezierCurve(points);
}

// The control polygon crosses itself: the derivative is zero at t = 1/2, where x is 5 and y 7.5.
TEST(BezierCurve, ACuspIsASharpTurn) {
    const BezierCurve cusp(std::vector<Vec3>{{0, 0, 0}, {10, 10, 0}, {0, 10, 0}, {10, 0, 0}});
    const auto turn = cusp.sharp_turn(0.001);
    ASSERT_TRUE(turn);
    EXPECT_LT(turn->first, 0.5);
    EXPECT_GT(turn->second, 0.5);
    EXPECT_NEAR(cusp.arc_length_to(turn->second) - cusp.arc_length_to(turn->first), 0.001, 1e-6);
    EXPECT_NEAR((cusp.at(turn->first) - Vec3(5, 7.5, 0)).norm(), 0.0005, 1e-6);
}

TEST(BezierCurve, RoundCurvesHaveNoSharpTurn) {
    EXPECT_FALSE(quarter().sharp_turn(0.001));
    // A loop of some tenths of a millimetre turns as much, but not within a micrometre.
    EXPECT_FALSE(BezierCurve(std::vector<Vec3>{{0, 0, 0}, {11, 10, 0}, {-1, 10, 0}, {10, 0, 0}}).sharp_turn(0.001));
}

TEST(BezierCurve, PartsLieOnTheWhole) {
    std::mt19937 random(7);
    for (int k = 0; k < 20; ++k) {
        const BezierCurve whole = random_curve(random);
        const auto [first, second] = whole.split_at(0.3);
        for (const double t : {0.0, 0.2, 0.7, 1.0}) {
            EXPECT_NEAR((first.at(t) - whole.at(0.3 * t)).norm(), 0, 1e-9);
            EXPECT_NEAR((second.at(t) - whole.at(0.3 + 0.7 * t)).norm(), 0, 1e-9);
        }
        EXPECT_NEAR(first.length() + second.length(), whole.length(), 1e-6);
    }
}

TEST(BezierCurve, AQuarterOfACircle) {
    const BezierCurve arc = quarter();
    EXPECT_NEAR(arc.length(), 5 * std::numbers::pi, 1e-9);
    EXPECT_NEAR(arc.turning(), std::numbers::pi / 2, 1e-9);
    for (int k = 0; k <= 20; ++k) {
        const CurveJet jet = arc.jet(k / 20.0);
        EXPECT_NEAR(jet.at.norm(), 10, 1e-13);
        // Curvature 1/10, and its derivative by the arc length 0.
        EXPECT_NEAR(jet.first.cross(jet.second).norm() / std::pow(jet.first.norm(), 3), 0.1, 1e-13);
        const Vec3 middle = arc.at(arc.at_arc_length(arc.length() * k / 20));
        EXPECT_NEAR(angle_of(middle.head<2>()), std::numbers::pi / 2 * k / 20, 1e-10);
    }
    const BezierCurve::Nearest nearest = arc.nearest({5, 5, 3});
    EXPECT_NEAR(nearest.t, 0.5, 1e-9);
    EXPECT_NEAR(nearest.distance, std::hypot(10 - 5 * std::numbers::sqrt2, 3.0), 1e-12);
}

TEST(BezierCurve, DerivativesAreThoseOfDifferences) {
    std::mt19937 random(1);
    constexpr double h = 1e-4;
    for (int k = 0; k < 50; ++k) {
        const BezierCurve curve = random_curve(random);
        const double t = 0.5;
        const CurveJet jet = curve.jet(t);
        const Vec3 before = curve.at(t - h), here = curve.at(t), behind = curve.at(t + h);
        const double scale = 1 + jet.third.norm();
        EXPECT_LE((jet.at - here).norm(), 1e-12);
        EXPECT_LE(((behind - before) / (2 * h) - jet.first).norm(), 1e-6 * scale);
        EXPECT_LE(((behind - 2 * here + before) / (h * h) - jet.second).norm(), 1e-3 * scale);
        EXPECT_LE(((curve.jet(t + h).second - curve.jet(t - h).second) / (2 * h) - jet.third).norm(), 1e-3 * scale);
    }
}

TEST(BezierCurve, ArcLengthAndItsInverseAgreeAndChordsStayWithinTheirError) {
    std::mt19937 random(2);
    for (int k = 0; k < 50; ++k) {
        const BezierCurve curve = random_curve(random);
        for (const double part : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0}) {
            const double t = curve.at_arc_length(part * curve.length());
            EXPECT_NEAR(curve.arc_length_to(t), part * curve.length(), 1e-9 * curve.length());
        }
        double from = 0, sum = 0;
        for (const double to : curve.chord_ends(1e-3)) {
            const Vec3 a = curve.at(from), b = curve.at(to);
            sum += (b - a).norm();
            for (int i = 1; i < 8; ++i) {
                const Vec3 p = curve.at(from + (to - from) * i / 8);
                const Vec3 along = (b - a).normalized();
                EXPECT_LE((p - a - (p - a).dot(along) * along).norm(), 1e-3);
            }
            from = to;
        }
        EXPECT_EQ(from, 1);
        EXPECT_NEAR(sum, curve.length(), 0.02 * curve.length());
        // No point of a fine table is closer than the closest point.
        const Vec3 p(3, -4, 5);
        double least = 1e9;
        for (int i = 0; i <= 2000; ++i) least = std::min(least, (curve.at(i / 2000.0) - p).norm());
        EXPECT_LE(curve.nearest(p).distance, least + 1e-6);
    }
}

TEST(BezierCurve, SpansOfTheTrident) {
    // Lo Valvo and Drago 2014: seven points, uniform clamped knots. The spans as polynomials, computed independently:
    // x = 10 + 30 p − 42 p² + 47/3 p³, y = 60 p − 78 p² + 31 p³ on the first, and so on.
    const Nurbs trident{3,
                        {{10, 0, 0}, {20, 20, 0}, {12, 8, 0}, {10, 20, 0}, {8, 8, 0}, {0, 20, 0}, {10, 0, 0}},
                        {},
                        {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}};
    const std::vector<NurbsSpan> spans = spans_of(trident);
    ASSERT_EQ(spans.size(), 4U);
    for (int k = 0; k <= 10; ++k) {
        const double p = k / 10.0;
        const Vec3 expected(10 + p * (30 + p * (-42 + p * 47 / 3)), p * (60 + p * (-78 + p * 31)), 0);
        EXPECT_LE((spans[0].curve.at(p) - expected).norm(), 1e-13);
        const Vec3 last(41.0 / 3 - 0, 13, 0);
        EXPECT_LE((spans[0].curve.at(1) - last).norm(), 1e-13);
    }
    double length = 0;
    for (const NurbsSpan& span : spans) length += span.curve.length();
    EXPECT_NEAR(length, 48.9956, 5e-5);  // as stated with the programs of the curve
    EXPECT_EQ(spans[2].last_point, 5U);
    // The curvature is continuous between spans.
    for (std::size_t i = 1; i < spans.size(); ++i)
        EXPECT_LE((spans[i].curve.jet(0).second - spans[i - 1].curve.jet(1).second).norm(), 1e-10);
}

TEST(BezierCurve, QuotientsOfPolynomials) {
    // A circle again: x = (1 − p²)/(1 + p²), y = 2 p/(1 + p²), p from 0 to 1.
    const std::vector<Vec3> numerator{{1, 0, 0}, {0, 2, 0}, {-1, 0, 0}};
    const std::vector<double> denominator{1, 0, 1};
    const BezierCurve arc = bezier_of(numerator, denominator, 1);
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(arc.at(k / 10.0).norm(), 1, 1e-14);
    EXPECT_LE((arc.at(0.5) - Vec3(0.6, 0.8, 0)).norm(), 1e-14);
    // Over another interval: p = 3 t.
    const BezierCurve cubic = bezier_of(std::vector<Vec3>{{1, 0, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 5}}, {}, 3);
    EXPECT_LE((cubic.at(1.0 / 3) - Vec3(3, 3, 5)).norm(), 1e-13);
    EXPECT_LE((cubic.at(1) - Vec3(31, 15, 135)).norm(), 1e-12);
}

TEST(BezierCurve, ADirectionWhereTheSpeedIsZero) {
    const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 0}, {5, 5, 0}, {10, 0, 0}};
    const BezierCurve curve(points);
    EXPECT_LE((curve.tangent(0) - Vec3(1, 1, 0).normalized()).norm(), 1e-3);
    EXPECT_TRUE(curve.moving_jet(0).first.norm() > 0);
    EXPECT_NEAR(curve.arc_length_to(curve.at_arc_length(1)), 1, 1e-9);
}

}  // namespace
}  // namespace clsurf::bezier_curve_test

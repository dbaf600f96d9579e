#include "toolpath/toolpath.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace clsurf::toolpath_test {
namespace {

Motions quarter_circle() {
    Motions m;
    m.start = Xyz(1, 0, 0);
    m.kind.push_back(MotionKind::ccw);
    m.end.push_back(Xyz(0, 1, 0));
    m.feed.push_back(1);
    m.line.push_back(1);
    m.arcs.push_back({0, Xyz(0, 0, 0), 1, 2});
    return m;
}

TEST(Toolpath, FindsTheFootOnAnArc) {
    const Motions m = quarter_circle();
    const Toolpath path(m, Vec3::Zero());
    const Projection projection = path.projection(0, Vec3(2, 2, 0));
    EXPECT_NEAR(projection.distance, std::sqrt(8.0) - 1, 1e-12);
    EXPECT_NEAR(projection.fraction, 0.5, 1e-12);
    EXPECT_NEAR(path.length(0), std::numbers::pi / 2, 1e-12);
}

TEST(Toolpath, DirectionsAndCurvatureOfAHelix) {
    Motions m = quarter_circle();
    EXPECT_LT((Toolpath(m, Vec3::Zero()).direction(0, 0.5) - Vec3(-1, 1, 0).normalized()).norm(), 1e-12);
    EXPECT_NEAR(Toolpath(m, Vec3::Zero()).curvature(0), 1, 1e-12);
    // A rise of 1 mm per radian: the direction at the beginning is (0, 1, 1)/√2, and κ = r / (r² + c²) = 1/2.
    m.end[0] = Xyz(0, 1, std::numbers::pi / 2);
    EXPECT_LT((Toolpath(m, Vec3::Zero()).direction(0, 0) - Vec3(0, 1, 1).normalized()).norm(), 1e-12);
    EXPECT_NEAR(Toolpath(m, Vec3::Zero()).curvature(0), 0.5, 1e-12);
}

TEST(Toolpath, FindsTheEndWhereTheAngleIsNotOnTheArc) {
    const Motions m = quarter_circle();
    EXPECT_NEAR(Toolpath(m, Vec3::Zero()).projection(0, Vec3(0, -3, 0)).distance, std::sqrt(10.0), 1e-12);
}

TEST(Toolpath, FindsTheTurnOfAHelix) {
    Motions m = quarter_circle();
    m.end[0] = Xyz(1, 0, 3);
    m.arcs[0].turns = 3;
    const Projection projection = Toolpath(m, Vec3::Zero()).projection(0, Vec3(-1, 0, 1.5));
    EXPECT_NEAR(projection.distance, 0.0, 1e-9);
    EXPECT_NEAR(projection.fraction, 0.5, 1e-9);
}

TEST(Toolpath, FindsTheFootOnASteepHelix) {
    // (cos t, sin t, 10 t), and a point 1.2 from its axis at the angle 0.5 and the height 7. The square of the distance,
    // 1 + 1.2² − 2.4 cos(t − 0.5) + (10 t − 7)², is smallest where t = 0.7 − 0.012 sin(t − 0.5); at t = 0.5 it is 4.04.
    Motions m = quarter_circle();
    m.end[0] = Xyz(0, 1, 5 * std::numbers::pi);
    double t = 0.7;
    for (int k = 0; k < 20; ++k) t = 0.7 - 0.012 * std::sin(t - 0.5);
    const double distance = std::sqrt(2.44 - 2.4 * std::cos(t - 0.5) + (10 * t - 7) * (10 * t - 7));
    EXPECT_NEAR(distance, 0.295, 0.001);
    const Projection found = Toolpath(m, Vec3::Zero()).projection(0, Vec3(1.2 * std::cos(0.5), 1.2 * std::sin(0.5), 7));
    EXPECT_NEAR(found.distance, distance, 1e-9);
    EXPECT_NEAR(found.fraction, t / (std::numbers::pi / 2), 1e-7);
    EXPECT_NEAR(Toolpath(m, Vec3::Zero()).projection(0, Vec3(1, 0, -2)).fraction, 0, 1e-12);
}

TEST(Toolpath, BeginsUnknownAxesWhereTheToolRests) {
    Motions m;
    m.kind.push_back(MotionKind::rapid);
    m.end.push_back(Xyz(10, 0, 0));
    m.feed.push_back(0);
    m.line.push_back(1);
    EXPECT_EQ(Toolpath(m, Vec3(1, 2, 3)).begin(0), Vec3(1, 2, 3));
}

TEST(Toolpath, FindsTheFootOnACurve) {
    // A parabola y = x (4 − x), given in x and y only: z is the position of the machine.
    Motions m = quarter_circle();
    m.arcs.clear();
    m.kind[0] = MotionKind::spline;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3> points{{0, 0, unknown}, {2, 8, unknown}, {4, 0, unknown}};
    m.start = Xyz(points.front());
    m.end[0] = Xyz(points.back());
    m.curves.push_back({0, std::make_shared<const BezierCurve>(points)});
    const Toolpath path(m, Vec3(0, 0, 7));
    const Projection top = path.projection(0, Vec3(2, 6, 7));
    EXPECT_NEAR(top.distance, 2, 1e-9);
    EXPECT_NEAR(top.fraction, 0.5, 1e-6);
    EXPECT_LE((path.at(0, 0.5) - Vec3(2, 4, 7)).norm(), 1e-9);
    // ∫ √(1 + (4 − 2x)²) dx over 0 … 4 = 2 √17 + ½ asinh 4.
    EXPECT_NEAR(path.length(0), 2 * std::sqrt(17.0) + 0.5 * std::asinh(4.0), 1e-8);
    // κ = 2 at the top; at the beginning the slope is 4.
    EXPECT_NEAR(path.curvature(0), 2, 1e-6);
    EXPECT_LE((path.direction(0, 0) - Vec3(1, 4, 0).normalized()).norm(), 1e-9);
    // The projection is searched only from a fraction of the path on.
    EXPECT_NEAR(path.projection(0, Vec3(1, 4, 7), 0.5).fraction, 0.5, 1e-6);
}

}  // namespace
}  // namespace clsurf::toolpath_test

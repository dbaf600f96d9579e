// Curvatures of rounded points on curves with known curvature.

#include "numeric/resolved_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numeric/speed_intervals.h"

namespace clsurf::resolved_curvature_test {
namespace {

constexpr double least = 1e-3;

Vec3 rounded(const Vec3& p, double step) { return (p / step).array().round() * step; }

std::vector<Vec3> circle(double radius, double spacing, double step) {
    std::vector<Vec3> points;
    for (double angle = 0; angle < 2; angle += spacing / radius)
        points.push_back(rounded(radius * Vec3(std::cos(angle), std::sin(angle), 0), step));
    return points;
}

TEST(ResolvedCurvature, OfRoundedCirclesIsRightWhereThreePointsAreNot) {
    constexpr double step = 0.001;
    for (const double radius : {2.0, 10.0, 50.0}) {
        for (const double spacing : {0.02, 0.05, 0.2, 1.0}) {
            const std::vector<Vec3> points = circle(radius, spacing, step);
            const std::vector<double> curvature = resolved_curvatures(points, step, least);
            double squares = 0;
            for (const double k : curvature) squares += (k * radius - 1) * (k * radius - 1);
            const double rms = std::sqrt(squares / static_cast<double>(curvature.size()));
            EXPECT_LT(rms, 0.12) << radius << " " << spacing;  // a tenth, plus the scatter of few points
        }
    }
    // 0.71 q/h² for h = 0.05 mm: three times the curvature of the circle.
    const std::vector<Vec3> points = circle(10, 0.05, step);
    double greatest = 0;
    for (const double k : curvatures(points)) greatest = std::max(greatest, k);
    EXPECT_GT(greatest, 0.4);
}

double greatest_of(const std::vector<double>& curvature) {
    return *std::max_element(curvature.begin(), curvature.end());
}

// The largest of thousands, which limits the speed, is as accurate as the others.
TEST(ResolvedCurvature, OfRoundedCirclesHasTheRightGreatest) {
    for (const double radius : {2.0, 10.0, 50.0}) {
        for (const double spacing : {0.01, 0.02, 0.05, 0.1, 0.5}) {
            const double greatest =
                greatest_of(resolved_curvatures(circle(radius, spacing, 0.001), 0.001, least)) * radius;
            EXPECT_GT(greatest, 0.99) << radius << " " << spacing;
            EXPECT_LT(greatest, 1.05) << radius << " " << spacing;
        }
    }
}

/// A line, an arc of radius 1 mm and a line.
std::vector<Vec3> fillet(double turn, double spacing, double step) {
    std::vector<Vec3> points;
    for (double way = -5; way < 5 + turn; way += spacing) {
        const double angle = std::clamp(way, 0.0, turn), beyond = way - angle;
        points.push_back(rounded(
            Vec3(std::sin(angle) + beyond * std::cos(angle), 1 - std::cos(angle) + beyond * std::sin(angle), 0), step));
    }
    return points;
}

TEST(ResolvedCurvature, OfAShortFilletIsSeen) {
    for (const double turn : {0.5, 0.8, std::numbers::pi / 2}) {
        for (const double spacing : {0.02, 0.05, 0.1}) {
            const double greatest = greatest_of(resolved_curvatures(fillet(turn, spacing, 0.001), 0.001, least));
            EXPECT_NEAR(greatest, 1, 0.1) << turn << " " << spacing;
        }
    }
}

TEST(ResolvedCurvature, OfExactPointsIsThatOfTheirCircle) {
    for (const double k : resolved_curvatures(circle(10, 0.5, 1e-9), 1e-9, least)) EXPECT_NEAR(k, 0.1, 1e-6);
}

// A bend of 30° in one point: 2 sin 15° over half of 0.05 mm … and nothing next to it.
TEST(ResolvedCurvature, KeepsACornerAndTheLinesBesideIt) {
    std::vector<Vec3> points;
    for (int i = -100; i <= 100; ++i) {
        const double way = 0.05 * i;
        points.push_back(
            rounded(i <= 0 ? Vec3(way, 0, 0)
                           : Vec3(way * std::cos(std::numbers::pi / 6), way * std::sin(std::numbers::pi / 6), 0),
                    0.001));
    }
    const std::vector<double> curvature = resolved_curvatures(points, 0.001, least);
    EXPECT_NEAR(curvature[100], 2 * std::sin(std::numbers::pi / 6) / (2 * 0.05 * std::cos(std::numbers::pi / 12)), 0.3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i < 99 || i > 101) { EXPECT_LT(curvature[i], 0.02) << i; }
    }
}

TEST(ResolvedCurvature, OfLinesIsNothing) {
    std::vector<Vec3> points;
    for (int i = 0; i < 500; ++i) points.push_back(rounded(Vec3(0.0437 * i, 0.0211 * i, 0), 0.001));
    for (const double k : resolved_curvatures(points, 0.001, least)) EXPECT_LT(k, 3e-4);
    EXPECT_TRUE(resolved_curvatures({}, 0.001, least).empty());
    EXPECT_EQ(resolved_curvatures(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, 0.001, least), std::vector<double>(2, 0.0));
}

TEST(ResolvedCurvature, IsTheSameForthAndBack) {
    std::vector<Vec3> points;
    for (int i = 0; i < 300; ++i) points.push_back(rounded(Vec3(0.05 * i, 0, 2 * std::sin(0.02 * i)), 0.001));
    const std::vector<double> forth = resolved_curvatures(points, 0.001, least);
    std::reverse(points.begin(), points.end());
    const std::vector<double> back = resolved_curvatures(points, 0.001, least);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(forth[i], back[points.size() - 1 - i], 1e-3) << i;
}

}  // namespace
}  // namespace clsurf::resolved_curvature_test

#include "machined/scallop_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/error.h"
#include "support/made_surface.h"

namespace clsurf::scallop_map_test {
namespace {

constexpr double length = 20, apart = 0.4;
constexpr int passes = 20;

/// Passes along X; `shape` maps points of the plane to tips.
ClSurface surface_of(const std::function<Vec3(const Vec3&)>& shape) {
    return test::made_zigzag(
               std::vector<double>(passes, 50), length, apart, [](const Vec3& tip, const Vec3&) { return tip; }, shape)
        .surface;
}

ClSurface plane(double tilt) {
    return surface_of(
        [=](const Vec3& flat) { return Vec3(flat.x(), flat.y() * std::cos(tilt), flat.y() * std::sin(tilt)); });
}

/// A cylinder along X, cut by a ball of radius `ball` with contact points `chord` apart; rho < 0: from inside.
ClSurface cylinder(double ball, double rho, double chord) {
    const double per_pass = 2 * std::asin(chord / (2 * std::abs(rho)));
    return surface_of([=](const Vec3& flat) {
        const double angle = (flat.y() / apart - 0.5 * (passes - 1)) * per_pass;
        const double centre = std::abs(rho) + (rho > 0 ? ball : -ball);
        return Vec3(flat.x(), centre * std::sin(angle), (rho > 0 ? 1 : -1) * centre * std::cos(angle) - ball);
    });
}

CuttingTool ball_of(double radius) { return {ToolKind::ball, radius, radius}; }

TEST(ScallopMap, OfPlanesIsThatOfTheChord) {
    const double height = 3 - std::sqrt(9 - 0.04);
    for (const double tilt : {0.0, 0.5}) {
        const ScallopMap map = scallop_map(plane(tilt), ball_of(3));
        EXPECT_NEAR(map.median, height, 1e-7);
        EXPECT_NEAR(map.p95, height, 1e-7);
        EXPECT_NEAR(map.most, height, 1e-7);
        EXPECT_EQ(map.uncut, 0);
    }
}

TEST(ScallopMap, OfCylindersIsThatOfTheCircles) {
    // Heights as in scallop_test.cpp, computed with 50 digits from the circles.
    EXPECT_NEAR(scallop_map(cylinder(2, 20, 0.336), ball_of(2)).median, 0.00777988785535, 2e-6);
    EXPECT_NEAR(scallop_map(cylinder(5, -30, 0.499), ball_of(5)).median, 0.00518940617738, 2e-6);
}

TEST(ScallopMap, WhatIsWiderThanTheToolStaysUncut) {
    // 19 gaps of 0.4 mm - 0.3 mm over 20 mm.
    const ScallopMap map = scallop_map(plane(0), ball_of(0.15));
    EXPECT_NEAR(map.uncut, 19 * 0.1 * length, 0.02 * 19 * 0.1 * length);
    EXPECT_NEAR(map.median, 0.15, 1e-7) << "what stands there is at least as high as the ball's radius";
}

TEST(ScallopMap, PercentilesAreOverTheLengthOfThePath) {
    // The last two gaps are twice as wide: three of twenty passes are next to one, 15 % of the length.
    const ClSurface surface = surface_of([](const Vec3& flat) {
        const double beyond = std::max(0.0, flat.y() / apart - (passes - 3));
        return Vec3(flat.x(), flat.y() + apart * beyond, 0);
    });
    const ScallopMap map = scallop_map(surface, ball_of(3));
    EXPECT_NEAR(map.median, 3 - std::sqrt(9 - 0.04), 1e-7);
    EXPECT_NEAR(map.p95, 3 - std::sqrt(9 - 0.16), 1e-7);
    EXPECT_NEAR(map.most, map.p95, 1e-7);
}

TEST(ScallopMap, RefusesOtherTools) { EXPECT_THROW((void)scallop_map(plane(0), {ToolKind::flat, 3, 0}), UsageError); }

}  // namespace
}  // namespace clsurf::scallop_map_test

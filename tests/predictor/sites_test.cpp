#include "predictor/sites.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::sites_test {
namespace {

/// A straight pass along a unit vector, from a start point on, with one point per millisecond.
struct StraightPass {
    ClSurface surface;
    Signals signals;

    StraightPass(const Vec3& from, const Vec3& along, double speed, int points) {
        surface.step_over = 0.4;
        surface.positions.origin = from;
        signals.samples.resize(static_cast<std::size_t>(points));
        for (int i = 0; i < points; ++i) {
            const Vec3 p = along * (i * speed * 0.001);
            surface.positions.x.push_back(static_cast<float>(p.x()));
            surface.positions.y.push_back(static_cast<float>(p.y()));
            surface.positions.z.push_back(static_cast<float>(p.z()));
            Sample& sample = signals[i];
            sample.speed = static_cast<float>(speed);
            for (Eigen::Index axis = 0; axis < 3; ++axis) sample.feed[axis] = static_cast<float>(along[axis]);
            sample.zone = Zone::inner;
        }
    }
    [[nodiscard]] std::vector<double> places(Eigen::Index axis) const {
        const Sites sites(surface, signals);
        std::vector<double> found;
        sites.for_each(0, signals.size(), [&](PointIndex i) {
            EXPECT_TRUE(sites.at(i));
            EXPECT_EQ(sites.nearest(i), i);
            const PathLocation at = sites.place(i);
            EXPECT_EQ(at.point, i - 1);
            found.push_back(surface.positions.origin[axis] +
                            static_cast<double>(position_at(surface.positions, at)[axis]));
        });
        return found;
    }
};

TEST(Sites, LieWherePlanesOfTheWorkpieceAreCrossed) {
    // 50 mm/s for 0.2 s from x = 0.013 on: planes at 0.2, 0.4 … 10.
    for (const double phase : {0.0, 0.013, 0.031, -0.02}) {
        const std::vector<double> places = StraightPass(Vec3(phase, 3, 5), Vec3(1, 0, 0), 50, 201).places(0);
        ASSERT_GE(places.size(), 49U);
        for (std::size_t k = 0; k < places.size(); ++k)
            EXPECT_NEAR(places[k], std::round(5 * places[k]) / 5, 1e-5) << "from " << phase;
        for (std::size_t k = 1; k < places.size(); ++k) EXPECT_NEAR(places[k] - places[k - 1], 0.2, 1e-5);
    }
}

TEST(Sites, BackwardsAreThoseOfTheArcLengthForth) {
    // From 0.013 to 10.013 and back.
    const std::vector<double> forth = StraightPass(Vec3(0.013, 0, 0), Vec3(1, 0, 0), 50, 201).places(0);
    std::vector<double> back = StraightPass(Vec3(10.013, 0.4, 0), Vec3(-1, 0, 0), 50, 201).places(0);
    ASSERT_EQ(forth.size(), back.size());
    std::reverse(back.begin(), back.end());
    for (std::size_t k = 0; k < forth.size(); ++k) EXPECT_NEAR(forth[k], back[k], 1e-5);
}

TEST(Sites, AreCloserWhereTheToolIsSlow) {
    // At 10 mm/s the spacing is halved twice; a third time it would be less than a tenth of the step-over.
    const std::vector<double> slow = StraightPass(Vec3(0.01, 0, 0), Vec3(1, 0, 0), 10, 201).places(0);
    EXPECT_EQ(slow.size(), 40U);  // 0.05 mm apart, of 2 mm
    for (const double place : slow) EXPECT_NEAR(place, std::round(20 * place) / 20, 1e-5);
    // Never closer, however slow the pass.
    const std::vector<double> slowest = StraightPass(Vec3(0.01, 0, 0), Vec3(1, 0, 0), 1, 2001).places(0);
    EXPECT_EQ(slowest, slow);
}

TEST(Sites, FollowTheAxisThatMovesMost) {
    const Vec3 along = Vec3(0.5, -0.7, 0.3).normalized();
    const std::vector<double> places = StraightPass(Vec3(1, 2, 3), along, 50, 401).places(1);
    EXPECT_EQ(places.size(), static_cast<std::size_t>(0.4 * 50 * std::abs(along.y()) / 0.2));
    for (const double place : places) EXPECT_NEAR(place, std::round(5 * place) / 5, 1e-5);
}

TEST(Sites, AreNoneOutsideOfPassesAndWhereTheToolStands) {
    StraightPass pass(Vec3(0.013, 0, 0), Vec3(1, 0, 0), 50, 201);
    for (PointIndex i = 0; i < 100; ++i) pass.signals[i].zone = Zone::outside;
    for (PointIndex i = 150; i < 201; ++i) pass.signals[i].speed = 0;
    for (const double place : pass.places(0)) {
        EXPECT_GT(place, 4.99);
        EXPECT_LT(place, 7.6);
    }
    const Sites sites(pass.surface, pass.signals);
    EXPECT_EQ(sites.nearest(40), 100);  // after x = 5, the first of all
    EXPECT_FALSE(sites.at(40));
}

}  // namespace
}  // namespace clsurf::sites_test

#include "machined/part_roughness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "machined/pass_ends.h"
#include "support/made_surface.h"

namespace clsurf::part_roughness_test {
namespace {

using test::MadeSurface;

constexpr double radius = 3, apart = 0.4;
constexpr int passes = 30;
constexpr double tilt = 0.5;  ///< [rad] tilt of the plane about X

/// A plane, tilted across the feed, with every second pass measured `lower` mm below the commanded one, along the normal.
MadeSurface alternating(double lower) {
    const Vec3 normal(0, -std::sin(tilt), std::cos(tilt));
    return test::made_zigzag(
        std::vector<double>(passes, 50), 12, apart,
        [=](const Vec3& commanded, const Vec3& feed) {
            return Vec3(feed.x() < 0 ? commanded - lower * normal : commanded);
        },
        [](const Vec3& flat) { return Vec3(flat.x(), flat.y() * std::cos(tilt), flat.y() * std::sin(tilt)); });
}

struct Cut {
    MadeSurface made;
    Signals signals;
    std::vector<PointRange> pieces;

    explicit Cut(MadeSurface surface) : made(std::move(surface)), signals(made.signals()) {
        for (const Pass& pass : made.surface.passes) pieces.push_back({pass.first, pass.last});
    }
    [[nodiscard]] AsMachinedSurface along(const Trajectory& swept) const {
        return {made.surface, signals, Role::commanded, swept, pieces, {ToolKind::ball, radius, radius}};
    }
    [[nodiscard]] PartRoughness roughness() const {
        const AsMachinedSurface measured = along(made.measured), commanded = along(made.path);
        return measure_roughness({measured, measured, &commanded}, roughness_places(measured, signals));
    }
};

/// The height above the plane, in its own coordinates: the lowest of the circles of pass k at k · apart, `lower` if k is odd.
double envelope(double across, double lower) {
    double z = std::numeric_limits<double>::infinity();
    for (int k = -8; k <= 8; ++k) {
        const double off = across - k * apart;
        if (std::abs(off) >= radius) continue;
        z = std::min(z, radius - std::sqrt(radius * radius - off * off) - (k % 2 != 0 ? lower : 0));
    }
    return z;
}

/// Heights of envelope(lower) minus `share` times those of equal passes.
AreaHeights in_theory(double lower, double share) {
    std::vector<float> z;
    for (int k = 0; k < 20000; ++k) {
        const double across = 2 * apart * k / 20000;
        z.push_back(static_cast<float>(envelope(across, lower) - share * envelope(across, 0)));
    }
    return area_heights(z);
}

TEST(PartRoughness, WhatTheMachineAddsIsTheDifferenceOfTheEnvelopes) {
    const double lower = 0.004;
    const AreaHeights expected = in_theory(lower, 1);
    const PartRoughness found = Cut(alternating(lower)).roughness();
    ASSERT_GT(found.machine.cells, 10'000U);
    EXPECT_NEAR(found.machine.sa, expected.sa, 0.03 * expected.sa);
    EXPECT_NEAR(found.machine.sq, expected.sq, 0.03 * expected.sq);
    EXPECT_NEAR(found.machine.sz, expected.sz, 0.05 * expected.sz);
}

TEST(PartRoughness, AMachineThatFollowsExactlyAddsNothing) {
    const PartRoughness found = Cut(alternating(0)).roughness();
    ASSERT_GT(found.machine.cells, 10'000U);
    EXPECT_LT(found.machine.sz, 1e-6);
    EXPECT_GT(found.rz, 0.006) << "the scallops of 0.4 mm, 6.7 µm, are there all the same";
}

TEST(PartRoughness, WithoutCommandedPositionsTheMachinesShareIsNotKnown) {
    const Cut cut(alternating(0.004));
    const AsMachinedSurface measured = cut.along(cut.made.measured);
    const PartRoughness found = measure_roughness({measured, measured}, roughness_places(measured, cut.signals));
    EXPECT_EQ(found.machine.cells, 0U);
    EXPECT_FALSE(found.patches.empty());
}

TEST(PartRoughness, AnotherRunIsMeasuredAtTheSamePlacesOverTheSameForm) {
    const Cut before(alternating(0)), after(alternating(0.004));
    const AsMachinedSurface first = before.along(before.made.measured), second = after.along(after.made.measured);
    const std::vector<RoughnessPlace> places = roughness_places(first, before.signals);
    const PartRoughness was = measure_roughness({first, first}, places),
                        is = measure_roughness({second, first}, places);
    ASSERT_EQ(was.patches.size(), is.patches.size());
    for (std::size_t k = 0; k < was.patches.size(); ++k) EXPECT_EQ(was.patches[k].point, is.patches[k].point);
    EXPECT_NEAR(was.sa, in_theory(0, 0).sa, 0.05 * was.sa);
    EXPECT_NEAR(is.sa, in_theory(0.004, 0).sa, 0.05 * is.sa);
    EXPECT_GT(is.sa, 1.2 * was.sa);
}

/// A zigzag of passes over a plane, inclined across the feed.
MadeSurface inclined(double step_over, double angle, double length) {
    return test::flat_zigzag(passes, length, step_over, 50, {}, [=](const Vec3& flat) {
        return Vec3(flat.x(), flat.y() * std::cos(angle), flat.y() * std::sin(angle));
    });
}

/// Heights of one scallop from cusp to cusp, R − √(R² − y²).
AreaHeights scallop_of(double step_over) {
    constexpr int count = 20001;
    std::vector<float> z;
    for (int k = 0; k < count; ++k) {
        const double y = step_over * (static_cast<double>(k) / (count - 1) - 0.5);
        z.push_back(static_cast<float>(radius - std::sqrt(radius * radius - y * y)));
    }
    return area_heights(z);
}

TEST(PartRoughness, IsThatOfWholeScallopsForAnyStepOverAndIncline) {
    struct Plane {
        double step_over = 0, angle = 0;
        double ra = 0;  ///< [mm] Ra of the scallops after a Gaussian filter of 0.8 mm along the plane, by NumPy
    };
    for (const Plane& plane : {Plane{0.35, 0, 0.0012764}, Plane{0.25, 0.26, 0.0006679}, Plane{0.4, 0.785, 0.0016080}}) {
        const AreaHeights expected = scallop_of(plane.step_over);
        const Cut cut(inclined(plane.step_over, plane.angle, 12));
        const AsMachinedSurface surface = cut.along(cut.made.path);
        const PartRoughness found = measure_roughness({surface, surface}, roughness_places(surface, cut.signals));
        EXPECT_NEAR(found.sa, expected.sa, 0.01 * expected.sa) << plane.step_over;
        EXPECT_NEAR(found.sq, expected.sq, 0.01 * expected.sq) << plane.step_over;
        EXPECT_NEAR(found.sz, expected.sz, 0.015 * expected.sz) << plane.step_over;
        EXPECT_NEAR(found.ra, plane.ra, 0.015 * plane.ra) << plane.step_over;
    }
}

TEST(PartRoughness, TwoRunsHaveTheCutoffOfTheFormWhateverTheirStepOvers) {
    const Cut first(inclined(0.4, 0, 12)), second(inclined(0.41, 0, 12));
    const AsMachinedSurface form_of = first.along(first.made.path), measured = second.along(second.made.path);
    const PartRoughness found = measure_roughness({measured, form_of}, roughness_places(form_of, first.signals));
    ASSERT_FALSE(found.patches.empty());
    EXPECT_EQ(found.cutoff, 0.8);
    for (const RoughPatch& patch : found.patches) EXPECT_EQ(patch.profile.cutoff, 0.8);
}

TEST(PartRoughness, BesideTheEndsOfPassesNothingIsHigherThanACusp) {
    // Where two passes end without a link between them, the cusp rises beyond their ends.
    constexpr double step_over = 0.3, length = 10;
    const Cut cut(inclined(step_over, 0.785, length));
    const AsMachinedSurface surface = cut.along(cut.made.path);
    for (const double from_end : {0.34, 0.4}) {
        const Vec2 at(length - from_end, surface.bounds().center().y());
        const RoughnessPlace place{0, Vec3(at.x(), at.y(), 0), {at, Vec2::UnitY(), step_over * std::cos(0.785), true}};
        const PartRoughness found = measure_roughness({surface, surface}, std::span(&place, 1));
        ASSERT_EQ(found.patches.size(), 1U);
        EXPECT_NEAR(found.sz, scallop_of(step_over).sz, 0.015 * scallop_of(step_over).sz) << from_end;
    }
}

TEST(PartRoughness, TheDistanceToTheCutOfACuspIsThatOfTheQuadraticForm) {
    const CuttingTool ball{ToolKind::ball, 3, 3}, bull{ToolKind::bull, 5, 2};
    EXPECT_EQ(cusp_before_contact(ball, Vec2(0, 0), 0.4), 0);
    EXPECT_EQ(cusp_before_contact(ball, Vec2(0, 1), 0.4), 0) << "along a contour line";
    EXPECT_EQ(cusp_before_contact(bull, Vec2(0.3, 0), 0.4), 0) << "along the fall line";
    // A slope of 45°, halfway between fall line and contour line: w² = 2, so that K = ((3, 1), (1, 3)) / 2 and 1/3 of 0.2 mm.
    EXPECT_NEAR(cusp_before_contact(ball, Vec2(std::sqrt(0.5), std::sqrt(0.5)), 0.4), 0.2 / 3, 1e-12);
    // A slope with sin θ = 0.6, w² = 1/0.64: r / (R − r + r sin θ) · sin θ = 1.2 / 4.2.
    const double fall = 1 / 0.64, contour = 1.2 / 4.2;
    EXPECT_NEAR(cusp_before_contact(bull, 0.75 * Vec2(0.6, 0.8), 0.4),
                0.2 * (fall - contour) * 0.48 / (0.36 * fall + 0.64 * contour), 1e-12);
    // On a level place the tool is flat along the contour lines: at most √(R · apart).
    EXPECT_NEAR(cusp_before_contact(bull, Vec2(0.0001, 0.001), 0.4), std::sqrt(2), 1e-12);
}

TEST(PartRoughness, CuspsOfABullNoseToolAreNoHigherBesideTheEndsOfPassesThatClimbAskew) {
    // Up a slope of 3°, 57° from the fall line: the cusps are cut 0.27 mm before the contacts, 0.7 step-overs. On a plane, the tool
    // leaves the cusps of the quadratic form h = ½ (K_vv − K_uv² / K_uu) (apart / 2)², normal to the plane.
    constexpr double step_over = 0.4, length = 10, slope = 0.0524078, turned = 33 * 0.017453292519943295;
    const CuttingTool tool{ToolKind::bull, 5, 2};
    const Vec2 fall(std::sin(turned), std::cos(turned));  // along the feed and across it
    const Cut cut(test::flat_zigzag(passes, length, step_over, 25, {}, [&](const Vec3& flat) {
        return Vec3(flat.x(), flat.y(), slope * fall.dot(flat.head<2>()));
    }));
    const AsMachinedSurface surface(cut.made.surface, cut.signals, Role::commanded, cut.made.path, cut.pieces, tool);
    const double steep = 1 + slope * slope;
    const double sine = slope / std::sqrt(steep);
    const double fall_bend = steep / 2, contour_bend = sine / (3 + 2 * sine);
    const double uu = fall_bend * fall.x() * fall.x() + contour_bend * fall.y() * fall.y();
    const double uv = (fall_bend - contour_bend) * fall.x() * fall.y();
    const double vv = fall_bend * fall.y() * fall.y() + contour_bend * fall.x() * fall.x();
    const double cusp = 0.5 * (vv - uv * uv / uu) * 0.25 * step_over * step_over;
    // Contacts are R − r + r sin θ up the fall line from the tips.
    const Vec2 contacts_end = Vec2(length, 0.5 * passes * step_over) + (3 + 2 * sine) * fall;
    for (const double from_end : {0.34, 0.6, 0.9}) {
        const Vec2 at = contacts_end - from_end * Vec2::UnitX();
        const RoughnessPlace place{0, Vec3(at.x(), at.y(), 0), {at, Vec2::UnitY(), step_over, true}};
        const PartRoughness found = measure_roughness({surface, surface}, std::span(&place, 1));
        ASSERT_EQ(found.patches.size(), 1U) << from_end;
        EXPECT_NEAR(found.sz, cusp, 0.015 * cusp) << from_end;
    }
}

/// A patch with known roughness `um` at a point.
RoughPatch patch_at(PointIndex point, double um) {
    RoughPatch patch;
    patch.point = point;
    patch.profile = {};
    patch.profile.ra = um;
    patch.profile.rz = 5 * um;
    patch.profile.length = 4;
    patch.area.sa = um;
    patch.area.cells = 1;
    return patch;
}

PartRoughness roughness_at(std::initializer_list<std::pair<PointIndex, double>> places) {
    PartRoughness roughness;
    for (const auto& [point, um] : places) {
        roughness.patches.push_back(patch_at(point, um));
        roughness.ra += um / static_cast<double>(places.size());
    }
    return roughness;
}

TEST(PartRoughness, TwoRunsAreComparedWhereBothAreKnown) {
    PartRoughness a = roughness_at({{10, 1}, {20, 2}, {30, 9}}), b = roughness_at({{10, 3}, {20, 4}});
    keep_common_patches(a, b);
    ASSERT_EQ(a.patches.size(), 2);
    EXPECT_DOUBLE_EQ(a.ra, 1.5);
    EXPECT_DOUBLE_EQ(a.rz, 7.5);
    EXPECT_DOUBLE_EQ(a.sa, 1.5);
    EXPECT_EQ(a.roughest, 1);
    EXPECT_DOUBLE_EQ(b.ra, 3.5);
    PartRoughness elsewhere = roughness_at({{40, 3}});
    keep_common_patches(a, elsewhere);
    EXPECT_TRUE(a.patches.empty());
    EXPECT_TRUE(elsewhere.patches.empty());
}

}  // namespace
}  // namespace clsurf::part_roughness_test

// Mismatch: which part of a relief is a mark, and which is the shape of the part.
#include "predictor/mismatch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/made_surface.h"

namespace clsurf::mismatch_test {
namespace {

constexpr double apart = 0.4;
constexpr int passes = 21;
constexpr double length = 40;

/// A surface z(x, y) under passes along X; the reliefs that differ from those around them, at every fifth point [mm].
template <typename Height>
std::vector<float> own_reliefs(const Height& height, double low, double high) {
    const test::MadeSurface made = test::flat_zigzag(passes, length, apart, 50, {}, [&](const Vec3& flat) {
        return Vec3(flat.x(), flat.y(), height(flat.x(), flat.y()));
    });
    const Signals signals = made.signals();
    const Comparer comparer(made.surface, signals, 12.5);
    std::vector<float> own;
    for (PointIndex i = 0; i < made.surface.positions.size(); i += 5) {
        const Vec3 p = made.surface.positions.absolute(i);
        if (p.x() < 5 || p.x() > length - 5 || p.y() < low || p.y() > high) continue;
        const Comparison c = comparer.compare({i, 0});
        const float residual = c.residual[index_of(Quantity::relief)];
        if (c.left >= 2 && c.right >= 2 && residual == residual)
            own.push_back(residual);  // no residual at tilted chords
    }
    EXPECT_GT(own.size(), 100U);
    return own;
}

TEST(Relief, OfAPassThatLiesOffIsAMark) {
    // The eleventh pass, and a band of the eleventh and the twelfth.
    for (const double to : {4.1, 4.5}) {
        for (const double off : {0.01, -0.01}) {
            const auto height = [&](double, double y) { return y > 3.9 && y < to ? off : 0.0; };
            // A band rises above the chord between a pass of it and one next to it.
            const double seen = to < 4.2 ? off : 0.5 * off;
            for (const float own : own_reliefs(height, 3.9, to)) EXPECT_NEAR(own, seen, 1e-5);
        }
    }
}

TEST(Relief, OfEverySecondPassIsAMark) {
    const auto height = [](double, double y) { return std::lround(y / apart) % 2 == 0 ? 0.01 : 0.0; };
    // The passes are compared with those between them, which are lower by twice as much as the chords.
    for (const float own : own_reliefs(height, 3.9, 4.1)) EXPECT_NEAR(own, 0.02, 1e-5);
}

TEST(Relief, OfAnEdgeOfThePartIsNone) {
    for (const double slope : {0.0, 0.05, -0.3}) {
        for (const double steep : {0.5, -0.5, 0.02}) {
            const auto roof = [&](double x, double y) {
                return -steep * std::abs(y - 4.07 - slope * (x - 0.5 * length));
            };
            for (const float own : own_reliefs(roof, 2, 6)) EXPECT_LT(std::abs(own), 1e-5F);
        }
    }
}

TEST(Relief, OfANarrowFilletIsNone) {
    // A floor and a wall of 45° with a radius of 0.9 mm between them, on which there are two passes.
    const auto height = [](double, double y) {
        constexpr double radius = 0.9;
        const double along = y - 4;
        if (along < 0) return 0.0;
        const double end = radius * std::sqrt(0.5);
        return along < end ? radius - std::sqrt(radius * radius - along * along)
                           : radius - std::sqrt(0.5) * radius + (along - end);
    };
    for (const float own : own_reliefs(height, 2, 6)) EXPECT_LT(std::abs(own), 1e-5F);
}

TEST(Relief, OfACreaseBesideACapIsNone) {
    // A cap of radius 3.7 mm that meets a floor of 7° where its slope is 70° to 73°: a pass next to the crease is 0.1 mm
    // below the chord over it, the adjacent one as much above its own, along the whole cap.
    constexpr double radius = 3.7;
    for (const double crease : {0.94, 0.945, 0.95, 0.955}) {
        const auto height = [&](double, double y) {
            const double along = y - 1, end = crease * radius;
            const double cap = std::sqrt(radius * radius - std::pow(std::min(along, end), 2));
            return cap - 0.13 * std::max(0.0, along - end);
        };
        for (const float own : own_reliefs(height, 2, 6.5)) EXPECT_LT(std::abs(own), 5e-3F) << crease;
    }
}

TEST(Relief, OfAWideFilletIsNone) {
    // A floor that continues into a fillet of 4 mm, straight or oblique to the passes: the curvature steps from 0 to 1/4
    // mm⁻¹, the reliefs from 0 to 20 µm, with one or two values in between.
    for (const double slope : {0.0, 0.02}) {
        const auto height = [&](double x, double y) {
            const double along = y - 4 - slope * (x - 0.5 * length);
            return along < 0 ? 0.0 : 4 - std::sqrt(16 - along * along);
        };
        for (const float own : own_reliefs(height, 2, 6)) EXPECT_LT(std::abs(own), 3e-4F);
    }
}

TEST(Thresholds, OfTheAccelerationIsWhatAChangeOfSpeedByItsThresholdShows) {
    // Passes at a constant 50 mm/s have no acceleration. 3 % of the speed in one step are 1.5 mm/s · 1.875 / 21 ms.
    const test::MadeSurface made = test::flat_zigzag(9, length, apart, 50, {});
    const Thresholds thresholds = measure_thresholds(made.surface, made.signals(), ThresholdRule{});
    EXPECT_NEAR(thresholds.of[index_of(Quantity::speed)], 0.03F, 1e-4F);
    EXPECT_NEAR(thresholds.of[index_of(Quantity::acceleration)], 1.5F * 1.875F / 0.021F, 4);
}

}  // namespace
}  // namespace clsurf::mismatch_test

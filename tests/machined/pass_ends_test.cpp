// Where passes end and the tool lifts, the form is no lower than the passes, and the as-machined surface is like that
// elsewhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "machined/form.h"
#include "support/made_surface.h"
#include "surface/path_location.h"

namespace clsurf::pass_ends_test {
namespace {

constexpr double per_degree = 0.017453292519943295;
constexpr double length = 8;
constexpr int passes = 16;

struct Lifted {
    double apart = 0.45, degrees = 20;  ///< step-over in plan view; slope of the plane, which rises across the feed
    double shorter = 0;                 ///< [mm] length by which every second pass is shorter
    double beside = 0;                  ///< [mm] shift along the feed while the tool lifts
    bool zigzag = false;
};

/// Passes on a plane; after each the tool lifts by 3 mm, moves above the next one and plunges.
test::MadeSurface lifted(const Lifted& of) {
    std::vector<Vec3> points;
    Passes found;
    const auto go = [&](const Vec3& to, double step) {
        const Vec3 from = points.back();
        const int pieces = std::max(1, static_cast<int>(std::lround((to - from).norm() / step)));
        for (int k = 1; k <= pieces; ++k) points.push_back(from + (to - from) * k / pieces);
    };
    for (int k = 0; k < passes; ++k) {
        const double y = k * of.apart;
        const bool back = of.zigzag && k % 2 == 1;
        const double end = length - (k % 2 == 1 ? of.shorter : 0);
        const Vec3 first(back ? end : 0, y, y * std::tan(of.degrees * per_degree)), last(back ? 0 : end, y, first.z());
        const Vec3 lift = 3 * Vec3::UnitZ();
        if (!points.empty()) {
            const auto rapid = static_cast<PointIndex>(points.size());
            go(points.back() + lift + (back ? 1 : -1) * of.beside * Vec3::UnitX(), 0.2);
            go(first + lift, 0.2);
            go(first + 0.1 * lift, 0.1);
            found.push_back({rapid, static_cast<PointIndex>(points.size()) - 1, PassKind::rapid});
        }
        const auto pass = static_cast<PointIndex>(points.size());
        points.push_back(first);
        go(last, 0.04);
        found.push_back({pass, static_cast<PointIndex>(points.size()) - 1, PassKind::cut});
    }
    return test::made_along(points, points, found, of.apart / std::cos(of.degrees * per_degree));
}

/// The largest and smallest deviation [mm] around the ends of the passes in the middle.
std::pair<float, float> at_ends(const Lifted& of, const CuttingTool& tool) {
    const test::MadeSurface made = lifted(of);
    const Signals signals = made.signals();
    std::vector<PointRange> pieces;
    for (const Pass& pass : made.surface.passes) pieces.push_back({pass.first, pass.last});
    const AsMachinedSurface as_machined(made.surface, signals, Role::commanded, made.path, pieces, tool);
    // In plan view, a contact is as far from the tip as the tool is wide there.
    const double aside = (tool.radius - tool.corner) + tool.corner * std::sin(of.degrees * per_degree);
    const double low_end = 4 * of.apart + (of.degrees > 0 ? aside : 0);
    const Box2 box(Vec2(length - of.shorter - 2, low_end), Vec2(length - of.shorter, low_end + 6 * of.apart));
    const Form form(as_machined, box);
    std::vector<float> known;
    (void)map_deviation(as_machined, form, frame_of(box, as_machined.usual_cell()),
                        [&](std::int64_t, std::span<float> rows) {
                            for (const float z : rows)
                                if (z == z) known.push_back(z);
                        });
    EXPECT_GT(known.size(), 1000U);
    if (known.empty()) return {};
    const auto [low, high] = std::minmax_element(known.begin(), known.end());
    return {*low, *high};
}

/// The cusp of a ball, or of the corner of a bull-nose tool, on a plane.
double cusp(const Lifted& of, double corner) {
    const double half = 0.5 * of.apart / std::cos(of.degrees * per_degree);
    return corner - std::sqrt(corner * corner - half * half);
}

TEST(PassEnds, ABallLeavesTheCuspsOfThePlaneUpToThem) {
    for (const double degrees : {0.0, 20.0, 30.0, 45.0}) {
        for (const Lifted& of :
             {Lifted{0.45, degrees}, Lifted{0.45, degrees, 0, 0, true}, Lifted{0.45, degrees, 0.7},
              Lifted{0.45, degrees, 0.1, 0, true}, Lifted{0.45, degrees, 0, 0.5}, Lifted{0.45, degrees, 0, -0.5}}) {
            const auto [low, high] = at_ends(of, {ToolKind::ball, 6, 6});
            // The cells of a map reach the tip of a cusp within a tenth.
            EXPECT_LT(high, 1.02 * cusp(of, 6)) << degrees << " " << of.shorter << " " << of.beside;
            EXPECT_GT(high, 0.9 * cusp(of, 6)) << degrees << " " << of.shorter << " " << of.beside;
            EXPECT_NEAR(low, 0, 0.00002) << degrees << " " << of.shorter << " " << of.beside;
        }
    }
}

TEST(PassEnds, TheCornerOfABullNoseToolDoes) {
    for (const Lifted& of : {Lifted{0.3, 20}, Lifted{0.3, 20, 0, 0, true}, Lifted{0.3, 30, 0.1}}) {
        const auto [low, high] = at_ends(of, {ToolKind::bull, 5, 2});
        EXPECT_LT(high, 1.02 * cusp(of, 2)) << of.degrees;
        EXPECT_GT(high, 0.9 * cusp(of, 2)) << of.degrees;
        EXPECT_NEAR(low, 0, 0.0001) << of.degrees;
    }
}

TEST(PassEnds, TheEdgeOfAFlatToolLeavesItsSteps) {
    for (const Lifted& of : {Lifted{0.3, 20}, Lifted{0.3, 20, 0, 0, true}}) {
        const auto [low, high] = at_ends(of, {ToolKind::flat, 4, 0});
        // The height of a step `apart` wide, normal to the plane through its corners.
        const double height = of.apart * std::sin(of.degrees * per_degree);
        EXPECT_NEAR(high - low, height, 0.05 * height) << of.degrees;
    }
}

TEST(PassEnds, WhatLiesBesideAnEndIsThePassNotTheLift) {
    const test::MadeSurface made = lifted({0.45, 20});
    const Passes& pieces = made.surface.passes;
    for (const Pass& pass : pieces) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.last - 3; i <= pass.last; ++i) {
            for (const Side side : {Side::left, Side::right}) {
                // A feed direction with the rounding error of the positions.
                const PathLocation at = adjacent_location(made.surface, {i, 0}, {1, 0, 1e-4F}, side);
                if (!at.exists()) continue;
                const Pass& beside_it = pieces[pass_of(pieces, at.point)];
                EXPECT_EQ(beside_it.kind, PassKind::cut) << i;
                EXPECT_LE(at.point + (at.fraction > 0 ? 1 : 0), beside_it.last) << i;
            }
        }
    }
}

}  // namespace
}  // namespace clsurf::pass_ends_test

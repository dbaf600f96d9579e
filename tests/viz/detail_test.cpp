// Detail: the triangles between passes have no gaps, and end with the passes.
#include "viz/detail.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/stitched_path.h"

namespace clsurf::viz::detail_test {
namespace {

using test::surface_of;

constexpr double pixels_per_mm = 20;

/// Seen from above, with (0, 0) in the middle; `values` empty: 1 everywhere.
Detail detail_of(const ClSurface& surface, std::vector<float> values = {}) {
    DetailRequest request;
    request.projection << pixels_per_mm, 0, 0, 500, 0, pixels_per_mm, 0, 500;
    request.width = request.height = 1000;
    if (values.empty()) values.resize(static_cast<std::size_t>(surface.positions.size()), 1.0F);
    return visible_detail(surface, values, request);
}

class Covered {
public:
    explicit Covered(const Detail& detail) : detail_(detail), g_(detail.geometry) {}
    /// Whether a triangle covers the point, with a value of at least that at a corner.
    bool operator()(double x, double y, float least = 0) const {
        for (std::size_t t = 0; t + 2 < g_.triangles.size(); t += 3) {
            if (std::max({value(t), value(t + 1), value(t + 2)}) < least) continue;
            double side[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 a = corner(t + k);
                const Vec2 b = corner(t + (k + 1) % 3);
                side[k] = (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
            }
            constexpr double tolerance = 1e-6;
            if ((side[0] >= -tolerance && side[1] >= -tolerance && side[2] >= -tolerance) ||
                (side[0] <= tolerance && side[1] <= tolerance && side[2] <= tolerance))
                return true;
        }
        return false;
    }

private:
    [[nodiscard]] float value(std::size_t k) const { return detail_.values[g_.triangles[k]]; }
    [[nodiscard]] Vec2 corner(std::size_t k) const {
        const std::size_t v = g_.triangles[k];
        return Vec2(g_.xyz[3 * v] + g_.origin.x(), g_.xyz[3 * v + 1] + g_.origin.y());
    }
    const Detail& detail_;
    const Geometry& g_;
};

TEST(Detail, LeavesNothingOpenWhereLoopsBegin) {
    const ClSurface surface = surface_of(test::loops(10, 12, 0.4, 0.02), 0.4);
    const Detail detail = detail_of(surface);
    const Covered covered(detail);
    for (double x = 5.65; x < 9.95; x += 0.043) {
        for (double y = -0.6; y < 0.6; y += 0.037) EXPECT_TRUE(covered(x, y)) << x << ' ' << y;
    }
    EXPECT_FALSE(covered(5.5, 0.01));
    EXPECT_FALSE(covered(10.1, 0.01));
}

TEST(Detail, DrawsAStepSidewaysNowhereElse) {
    ClSurface surface = surface_of(test::loops(10, 12, 0.4, 0.02), 0.4);
    std::vector<float> values(static_cast<std::size_t>(surface.positions.size()), 1.0F);
    const auto in_jog = [&](PointIndex i) {
        return i > 0 && surface.positions[i].y() == 0 && surface.positions[i - 1].y() == 0;
    };
    for (PointIndex i = 0; i < surface.positions.size(); ++i) {
        if (!in_jog(i)) continue;
        values[static_cast<std::size_t>(i)] = 100;
        if (in_jog(i - 1))
            surface.step_over_moves.back().last = i;
        else
            surface.step_over_moves.push_back({i, i});
    }
    ASSERT_EQ(surface.step_over_moves.size(), 11U);
    const Detail detail = detail_of(surface, values);
    const Covered covered(detail);
    for (double x = 5.65; x < 9.95; x += 0.043) {
        for (double y = -0.6; y < 0.6; y += 0.037) {
            EXPECT_TRUE(covered(x, y)) << x << ' ' << y;
            if (std::abs(y) > 0.04) { EXPECT_FALSE(covered(x, y, 2)) << x << ' ' << y; }
        }
    }
}

TEST(Detail, EndsInALineWhereThePassesDo) {
    // On a flank that rises along and across the passes, the point opposite to the end of one is not the end of the other.
    Positions positions = test::zigzag(12, 20, 0.4, 0.02);
    for (std::size_t i = 0; i < positions.x.size(); ++i) positions.z[i] = 0.7F * positions.x[i] + 0.7F * positions.y[i];
    const ClSurface surface = surface_of(std::move(positions), 0.45);
    const Detail detail = detail_of(surface);
    const Covered covered(detail);
    for (double y = 0.02; y < 4.38; y += 0.037) {
        for (const double x : {0.02, 0.1, 0.3, 19.7, 19.9, 19.98}) EXPECT_TRUE(covered(x, y)) << x << ' ' << y;
        EXPECT_FALSE(covered(-0.05, y)) << y;
        EXPECT_FALSE(covered(20.05, y)) << y;
    }
}

TEST(Detail, LeavesAMissingPassOpen) {
    // Two zigzags, which together lack a seventh pass.
    Positions positions = test::zigzag(6, 10, 0.4, 0.02);
    const Positions other = test::zigzag(6, 10, 0.4, 0.02);
    for (PointIndex i = 0; i < other.size(); ++i) test::add(positions, other[i].x(), other[i].y() + 2.8, 0);
    const ClSurface surface = surface_of(std::move(positions), 0.4);
    const Detail detail = detail_of(surface);
    const Covered covered(detail);
    EXPECT_TRUE(covered(5, 1.9));
    EXPECT_FALSE(covered(5, 2.41));
    EXPECT_TRUE(covered(5, 2.9));
}

}  // namespace
}  // namespace clsurf::viz::detail_test

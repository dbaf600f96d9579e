// Curves that replace lines: which lines, their path, and that they do not depend on the direction of travel.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "simulation/path/curve_blocks.h"
#include "support/made_motion.h"

namespace clsurf::curve_blocks_test {
namespace {

std::string lines_through(const std::vector<Vec3>& points) {
    const Vec3& first = points.front();
    std::string text = fmt::format("G64 P0.02\nG0 X{:.6f} Y{:.6f} Z{:.6f}\n", first.x(), first.y(), first.z());
    for (const Vec3& p : points) text += fmt::format("G1 X{:.6f} Y{:.6f} Z{:.6f} F3000\n", p.x(), p.y(), p.z());
    return text + "M2\n";
}

/// The elements of a program's only section after the rapid to its first point.
std::vector<PathElement> shaped(const std::vector<Vec3>& points, CurveMode mode) {
    const Program program = program_of(lines_through(points));
    const Machine machine;
    WholeProgram motions(program);
    BlockStream blocks(motions, machine, Vec3(-1, -1, -1));
    CurveBlocks curves(blocks, mode);
    std::vector<PathElement> elements;
    EXPECT_TRUE(blocks.begin_section());
    PathElement e;
    EXPECT_TRUE(curves.next(e));  // the rapid
    while (curves.next(e)) elements.push_back(e);
    return elements;
}

/// Lines and arcs, with points unevenly spaced.
std::vector<Vec3> passes(std::mt19937& random) {
    std::uniform_real_distribution<double> step(0.3, 1), bend(-0.15, 0.15);
    std::vector<Vec3> points{Vec3(0.5, 0.25, 0)};
    double angle = 0;
    for (int piece = 0; piece < 6; ++piece) {
        const double curvature = piece % 2 == 0 ? 0 : bend(random);
        for (int k = 0; k < 12; ++k) {
            const double length = step(random);
            angle += length * curvature;
            points.push_back(points.back() + length * Vec3(std::cos(angle), std::sin(angle), 0.05));
        }
    }
    return points;
}

class Curves : public testing::TestWithParam<CurveMode> {};

TEST_P(Curves, AreTheSameForthAndBack) {
    std::mt19937 random(11);
    std::size_t cubics = 0;
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<Vec3> points = passes(random);
        const std::vector<PathElement> forth = shaped(points, GetParam());
        std::reverse(points.begin(), points.end());
        const std::vector<PathElement> back = shaped(points, GetParam());
        ASSERT_EQ(forth.size(), points.size() - 1);
        ASSERT_EQ(back.size(), forth.size());
        for (std::size_t i = 0; i < forth.size(); ++i) {
            const PathElement& other = back[back.size() - 1 - i];
            cubics += forth[i].cubic;
            EXPECT_EQ(forth[i].cubic, other.cubic);
            EXPECT_NEAR(forth[i].length, other.length, 1e-5);
            EXPECT_LT((forth[i].at(0.3 * forth[i].length) - other.at(0.7 * other.length)).norm(), 1e-5)
                << trial << " block " << i;
        }
    }
    EXPECT_GT(cubics, 50U * 60);
}

TEST_P(Curves, StandForTheirBlocksAndJoin) {
    std::mt19937 random(12);
    const std::vector<Vec3> points = passes(random);
    const std::vector<PathElement> elements = shaped(points, GetParam());
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const PathElement& e = elements[i];
        EXPECT_EQ(e.line, static_cast<LineNumber>(i + 4));  // after G64, the rapid and the first point again
        EXPECT_EQ(e.block, static_cast<std::int64_t>(i + 1));
        EXPECT_LE(e.deviation, 0.01);
        EXPECT_LE((e.at(0) - points[i]).norm(), e.deviation + 1e-5);
        const Vec3 before = i > 0 ? elements[i - 1].at(elements[i - 1].length) : e.begin;
        EXPECT_LT((e.at(0) - before).norm(), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Curves, testing::Values(CurveMode::akima, CurveMode::least_squares),
                         [](const auto& mode) { return mode.param == CurveMode::akima ? "akima" : "least_squares"; });

// R 20 mm in chords of 1 mm, which deviate by 6 µm: Akima's curve deviates by less than a hundredth of that.
TEST(CurveBlocks, RunSharpCubicsByTheirArcLength) {
    // Most of the turn is in a small part of the curve, where the position changes slowly with u.
    const CubicSpan sharp = hermite(Vec3::Zero(), Vec3(1, 0.4, 0), Vec3(1.6, -0.9, 0.2), Vec3(0.3, 1.4, -0.3), 1);
    const PathElement element = element_of(sharp);
    // Its length by chords, which are shorter by about one part in 10¹¹.
    constexpr int chords = 200000;
    constexpr double step = 1.0 / chords;
    double length = 0;
    for (int k = 1; k <= chords; ++k) length += (sharp.at(k * step) - sharp.at((k - 1) * step)).norm();
    EXPECT_NEAR(element.length, length, 1e-9);
    // Steps of equal length move the position by equal distances: central differences of four points.
    const double h = 1e-3 * element.length;
    for (int k = 1; k < 100; ++k) {
        const double s = element.length * k / 100;
        const Vec3 slope =
            (element.at(s - 2 * h) - 8 * element.at(s - h) + 8 * element.at(s + h) - element.at(s + 2 * h)) / (12 * h);
        EXPECT_NEAR(slope.norm(), 1, 1e-7) << k;
    }
}

TEST(CurveBlocks, TakeTheFacetsOutOfACircle) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 60; ++i) points.emplace_back(20 * std::sin(0.05 * i), 20 - 20 * std::cos(0.05 * i), 0);
    const auto farthest_off = [&](CurveMode mode) {
        double farthest = 0;
        const std::vector<PathElement> elements = shaped(points, mode);
        for (std::size_t i = 5; i + 5 < elements.size(); ++i) {
            for (const double part : {0.0, 0.25, 0.5, 0.75})
                farthest = std::max(farthest,
                                    std::abs((elements[i].at(part * elements[i].length) - Vec3(0, 20, 0)).norm() - 20));
        }
        return farthest;
    };
    EXPECT_LT(farthest_off(CurveMode::akima), 6e-5);
    EXPECT_LT(farthest_off(CurveMode::least_squares), 2e-3);
}

}  // namespace
}  // namespace clsurf::curve_blocks_test

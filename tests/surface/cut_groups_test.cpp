// Passes of two tools, or of two runs of a program in one log, are above each other: they are not neighbours.
#include "surface/cut_groups.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program/motion_rows.h"
#include "support/made_path.h"
#include "surface/stitch.h"

namespace clsurf::cut_groups_test {
namespace {

constexpr double apart = 0.3, length = 20, record = 0.05;  // mm

struct Cut {
    Positions positions;
    Column<std::uint32_t> motions;

    /// Adds a path at a height; `motion_of`(y) gives the motions.
    template <typename MotionOf>
    void add(const Positions& path, float z, const MotionOf& motion_of) {
        for (PointIndex i = 0; i < path.size(); ++i) {
            test::add(positions, path[i].x(), path[i].y(), z);
            motions.push_back(motion_of(path[i].y()));
        }
    }
    void lift(std::uint32_t motion) {
        test::add(positions, 0, 0, 10);
        motions.push_back(motion);
    }
};

ClSurface surface_of(Cut cut, const std::string& text) {
    const Program program = parse(text, "linuxcnc");
    const LineMap lines(std::move(cut.motions),
                        Column<std::uint8_t>(static_cast<std::size_t>(cut.positions.size()), 255), program);
    return stitch(std::move(cut.positions), lines);
}

/// Passes 1 mm apart and 0.3 mm high, and finishing passes over them.
ClSurface semi_finished_and_finished(const char* second_tool) {
    Cut cut;
    cut.add(test::zigzag(12, length, 1.0, record), 0.3F, [](float) { return 0U; });
    cut.lift(1);
    cut.add(test::zigzag(36, length, apart, record), 0, [](float) { return 2U; });
    return surface_of(std::move(cut), fmt::format("T1 M6\nG1 X1 F100\nG0 Z10\n{} M6\nG1 X2\n", second_tool));
}

/// The number of neighbours on passes of another height, and of all neighbours.
std::pair<int, int> across_heights(const ClSurface& surface) {
    std::pair<int, int> found;
    const Positions& p = surface.positions;
    for (PointIndex i = 0; i < p.size(); ++i) {
        for (const Side side : {Side::left, Side::right}) {
            if (!surface.neighbours.has(side, i)) continue;
            ++found.second;
            found.first += p[surface.neighbours.neighbour(side, i)].z() != p[i].z() ? 1 : 0;
        }
    }
    return found;
}

TEST(CutGroups, PassesOfTwoToolsAreNoNeighbours) {
    const ClSurface surface = semi_finished_and_finished("T2");
    EXPECT_NEAR(surface.step_over, apart, 0.01);
    const auto [across, all] = across_heights(surface);
    EXPECT_EQ(across, 0);
    EXPECT_GT(all, 20000);
    EXPECT_GT(across_heights(semi_finished_and_finished("T1")).first, 1000);  // one tool: unknown
}

std::string lines_of(int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += fmt::format("G1 X{} F100\n", k + 1);
    return text + "G0 Z10\n";
}

/// Passes first … last of a zigzag, one motion each.
Positions passes_of(int first, int last) {
    const Positions whole = test::zigzag(20, length, apart, record);
    Positions some;
    for (PointIndex i = 0; i < whole.size(); ++i) {
        if (whole[i].y() > first * apart - 0.01 && whole[i].y() < last * apart + 0.01)
            test::add(some, whole[i].x(), whole[i].y(), 0);
    }
    return some;
}

std::uint32_t motion_of(float y) { return static_cast<std::uint32_t>(std::lround(y / apart)); }

TEST(CutGroups, PassesOfTwoRunsAreNoNeighbours) {
    Cut cut;
    for (int run = 0; run < 2; ++run) {
        cut.add(passes_of(0, 19), 0, motion_of);
        cut.lift(20);
    }
    const PointIndex second = cut.positions.size() / 2;
    const ClSurface surface = surface_of(std::move(cut), lines_of(20));
    EXPECT_NEAR(surface.step_over, apart, 0.01);
    int cuts = 0;
    for (const Pass& pass : surface.passes) cuts += pass.kind == PassKind::cut ? 1 : 0;
    EXPECT_EQ(cuts, 40);
    int inner = 0;
    for (PointIndex i = 0; i < surface.positions.size(); ++i) {
        const Eigen::Vector3f p = surface.positions[i];
        if (p.x() < 1 || p.x() > 19 || p.y() < 0.2 || p.y() > 5.5 || p.z() > 1) continue;
        for (const Side side : {Side::left, Side::right}) {
            ASSERT_TRUE(surface.neighbours.has(side, i)) << i;
            EXPECT_EQ(surface.neighbours.neighbour(side, i) < second, i < second) << i;
            ++inner;
        }
    }
    EXPECT_GT(inner, 10000);
}

TEST(CutGroups, ARestartedRunHasItsOwnPassesWhereItHasThem) {
    Cut cut;
    cut.add(passes_of(0, 12), 0, motion_of);
    const PointIndex second = cut.positions.size() + 1;
    cut.lift(20);
    cut.motions.back() = 12;  // the retract has the number of the stopped line
    cut.add(passes_of(8, 19), 0, motion_of);
    const ClSurface surface = surface_of(std::move(cut), lines_of(20));
    int first_again = 0;
    for (PointIndex i = second; i < surface.positions.size(); ++i) {
        const Eigen::Vector3f p = surface.positions[i];
        if (p.x() < 1 || p.x() > 19 || p.y() > 3.5) continue;
        const auto pass = static_cast<int>(motion_of(p.y()));
        for (const Side side : {Side::left, Side::right}) {
            ASSERT_TRUE(surface.neighbours.has(side, i)) << i;
            const PointIndex n = surface.neighbours.neighbour(side, i);
            const auto beside = static_cast<int>(motion_of(surface.positions[n].y()));
            EXPECT_EQ(std::abs(beside - pass), 1) << i;
            EXPECT_EQ(n < second, beside < 8) << i;  // pass 7 was cut once, before the stop
            first_again += beside < 8 ? 1 : 0;
        }
    }
    EXPECT_GT(first_again, 300);
}

}  // namespace
}  // namespace clsurf::cut_groups_test

// Height maps of swept pieces compared with the outline's formula at many places along each of them.

#include "machined/swept_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace clsurf::swept_pieces_test {
namespace {

struct Motion {
    Vec3 from, to;
};

/// The tool's outline above its tip, `rho` from the axis: a corner of radius c around a flat bottom of radius R − c.
double outline(const CuttingTool& tool, double rho) {
    if (rho > tool.radius) return std::numeric_limits<double>::infinity();
    const double out = std::max(0.0, rho - (tool.radius - tool.corner));
    return tool.corner - std::sqrt(std::max(0.0, tool.corner * tool.corner - out * out));
}

/// The lowest outline above a place, of tools along a motion, ends included: first coarsely, then around the lowest.
double lowest_over(const CuttingTool& tool, const Motion& motion, double x, double y) {
    const auto over = [&](double t) {
        const Vec3 tip = motion.from + t * (motion.to - motion.from);
        return tip.z() + outline(tool, std::hypot(x - tip.x(), y - tip.y()));
    };
    double lowest = std::numeric_limits<double>::infinity();
    double from = 0, to = 1;
    for (int round = 0; round < 5; ++round) {
        constexpr int steps = 30;
        double at = from;
        for (int k = 0; k <= steps; ++k) {
            const double t = from + (to - from) * k / steps;
            if (over(t) > lowest) continue;
            lowest = over(t);
            at = t;
        }
        const double step = (to - from) / steps;
        from = std::max(0.0, at - step);
        to = std::min(1.0, at + step);
    }
    return lowest;
}

/// A path on a wavy surface, passes back and forth, with a few plunges.
std::vector<Motion> wavy_path(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const double tilt_x = 0.4 * any(random), tilt_y = 0.4 * any(random), wave = 0.03 * any(random);
    std::vector<Motion> motions;
    Vec3 before = Vec3::Zero();
    for (int pass = 0; pass < 7; ++pass) {
        for (int k = 0; k <= 14; ++k) {
            const double x = 0.2 * (pass % 2 == 0 ? k : 14 - k) - 0.7 + 0.02 * any(random), y = 0.3 * pass - 0.4;
            const Vec3 at(x, y, tilt_x * x + tilt_y * y + wave * std::sin(4 * x + 3 * y));
            if (pass + k > 0) motions.push_back({before, at});
            before = at;
        }
        motions.push_back({before, before - Vec3(0, 0, 0.01)});
    }
    return motions;
}

TEST(SweptPieces, LeaveTheLowestOutlineOfAllPlacesAlongThem) {
    std::mt19937 random(7);
    for (const CuttingTool& tool : {CuttingTool{ToolKind::ball, 1, 1}, CuttingTool{ToolKind::bull, 1, 0.3},
                                    CuttingTool{ToolKind::flat, 0.8, 0}}) {
        for (const auto& [columns, rows] : {std::pair(21, 17), std::pair(81, 1), std::pair(23, 3), std::pair(3, 1)}) {
            const std::vector<Motion> motions = wavy_path(random);
            constexpr double cell = 0.037, row_pitch = 0.041;
            SweptPieces pieces;
            for (const Motion& m : motions) pieces.add(m.from, m.to, longest_piece(tool, cell));
            std::vector<float> z(static_cast<std::size_t>(columns * rows), std::numeric_limits<float>::infinity());
            lower(tool, pieces, {z.data(), columns, rows, static_cast<float>(cell), static_cast<float>(row_pitch)});
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    double expected = std::numeric_limits<double>::infinity();
                    for (const Motion& m : motions)
                        expected = std::min(expected, lowest_over(tool, m, cell * column, row_pitch * row));
                    const float found = z[static_cast<std::size_t>(row * columns + column)];
                    const std::string where = std::to_string(column) + ", " + std::to_string(row);
                    if (std::isinf(expected))
                        EXPECT_EQ(found, expected) << where;
                    else
                        EXPECT_NEAR(found, expected, 3e-6) << to_text(tool) << " " << where;
                }
            }
        }
    }
}

TEST(SweptPieces, UnderAFlatBottomAllThatIsEvenIsLeftAsItIs) {
    const CuttingTool tool{ToolKind::bull, 3, 1};
    SweptPieces pieces;
    for (int pass = 0; pass < 20; ++pass) {
        for (int k = 0; k < 40; ++k)
            pieces.add(Vec3(0.1 * k - 2, 0.1 * pass - 1, 5), Vec3(0.1 * k - 1.9, 0.1 * pass - 1, 5), 0.1);
    }
    std::vector<float> z(32 * 32, std::numeric_limits<float>::infinity());
    lower(tool, pieces, {z.data(), 32, 32, 0.02F, 0.02F});
    for (const float height : z) EXPECT_EQ(height, 5.0F);
}

}  // namespace
}  // namespace clsurf::swept_pieces_test

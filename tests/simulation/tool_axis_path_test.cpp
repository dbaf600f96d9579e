// Interpolation of the tool axis compared with independent vectors, and through the pole.

#include "simulation/path/tool_axis_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/vector_rows.h"

namespace clsurf::tool_axis_path_test {
namespace {

constexpr double degree = std::numbers::pi / 180;
const AngleRange any;

Kinematics trunnion(ToolAxisInterpolation interpolation) {
    Kinematics k;
    k.type = KinematicsType::table_table;
    k.interpolation = interpolation;
    return k;
}

TEST(ToolAxisPath, AgreesWithIndependentVectors) {
    for (VectorRow& row : vector_rows("simulation", "tool_axis_interpolation.txt")) {
        ASSERT_EQ(row.word(), "AC");
        const std::vector<double> ends = row.numbers(4);
        const RotaryAngles from{ends[0] * degree, ends[1] * degree};
        const RotaryAngles to{ends[2] * degree, ends[3] * degree};
        (void)row.number();  // out of plane
        const double error = row.number();
        const double least_tilt = row.number();
        const Kinematics linear = trunnion(ToolAxisInterpolation::linear);
        EXPECT_NEAR(ToolAxisPath(linear, from, to, any, 1e9, 0).greatest_error(2000), error, 1e-6 + 1e-4 * error)
            << row.name;
        const Kinematics vector = trunnion(ToolAxisInterpolation::vector);
        const ToolAxisPath path(vector, from, to, any, 1e9, 0);
        double least = 10;
        for (int i = 0; i <= 2000; ++i) least = std::min(least, std::abs(path.at(i / 2000.0).tilt));
        EXPECT_NEAR(least, least_tilt, 1e-6 + 1e-4 * least_tilt) << row.name;
        for (int i = 0; i < 3; ++i) {
            const double part = row.number();
            const std::vector<double> t = row.numbers(3);
            const Vec3 expected(t[0], t[1], t[2]);
            EXPECT_LE((great_circle(linear.axis_of(from), linear.axis_of(to), part) - expected).norm(), 2e-9)
                << row.name;
            EXPECT_LE((vector.axis_of(path.at(part)) - expected).norm(), 1e-8) << row.name;
        }
    }
}

TEST(PoleWindow, AgreesWithIndependentVectors) {
    for (VectorRow& row : vector_rows("simulation", "pole_window.txt")) {
        const double tilt = row.number();
        const PoleWindow window = pole_window(tilt, row.number());
        const std::vector<double> expected = row.numbers(3);
        EXPECT_NEAR(window.half, expected[0], 1e-7 + 1e-4 * expected[0]) << row.name;
        EXPECT_NEAR(window.greatest_speed, expected[1], 1e-4 * expected[1]) << row.name;
        EXPECT_NEAR(window.greatest_bend, expected[2], 1e-4 * expected[2]) << row.name;
    }
}

// From 45°, C 0 to 45°, C 178°: linear interpolation errs by 44°; across the other side of the tilt by 1°, with C turning by
// only 2°; if the tilt may not go there, the rotation follows the given ratio.
TEST(ToolAxisPath, SafePassesThePole) {
    const Kinematics k = trunnion(ToolAxisInterpolation::safe);
    const RotaryAngles from{45 * degree, 0};
    const RotaryAngles to{45 * degree, 178 * degree};
    const ToolAxisPath over(k, from, to, {-95 * degree, 95 * degree}, 20, 1.1 * degree);
    EXPECT_NEAR(over.at(1).tilt, -45 * degree, 1e-12);
    EXPECT_NEAR(over.at(1).rotation, -2 * degree, 1e-12);
    EXPECT_NEAR(over.greatest_error(1000), 1.0 * degree, 0.02 * degree);
    const double ratio = 20;
    const ToolAxisPath window(k, from, to, {0, 95 * degree}, ratio, 1.1 * degree);
    const double angle = angle_between(k.axis_of(from), k.axis_of(to));
    double before = window.at(0).rotation;
    double fastest = 0;
    for (int i = 1; i <= 20000; ++i) {
        const double now = window.at(i / 20000.0).rotation;
        fastest = std::max(fastest, std::abs(now - before) / (angle / 20000));
        before = now;
    }
    EXPECT_LE(fastest, ratio * 1.001);
    EXPECT_GT(fastest, 0.9 * ratio);
    EXPECT_NEAR(before, 178 * degree, 1e-9);
    EXPECT_LT(window.greatest_error(2000), 0.63 / ratio);
}

TEST(ToolAxisPath, DegenerateEnds) {
    for (const ToolAxisInterpolation mode :
         {ToolAxisInterpolation::linear, ToolAxisInterpolation::vector, ToolAxisInterpolation::safe}) {
        const Kinematics k = trunnion(mode);
        for (const auto& [from, to] :
             {std::pair{RotaryAngles{0, 0}, RotaryAngles{0, 2}}, std::pair{RotaryAngles{0, 0}, RotaryAngles{0.5, 1}},
              std::pair{RotaryAngles{0.5, 0}, RotaryAngles{0.5, std::numbers::pi}},
              std::pair{RotaryAngles{0.3, 1}, RotaryAngles{0.3, 1}},
              std::pair{RotaryAngles{0, 0}, RotaryAngles{std::numbers::pi, 0}}}) {
            const ToolAxisPath path(k, from, to, any, 20, 0.01);
            for (int i = 0; i <= 100; ++i) {
                const RotaryAngles at = path.at(i / 100.0);
                ASSERT_TRUE(std::isfinite(at.tilt) && std::isfinite(at.rotation));
            }
            EXPECT_LE(angle_between(k.axis_of(path.at(1)), k.axis_of(to)), 1e-6);
            EXPECT_LE(angle_between(k.axis_of(path.at(0)), k.axis_of(from)), 1e-6);
        }
    }
}

}  // namespace
}  // namespace clsurf::tool_axis_path_test

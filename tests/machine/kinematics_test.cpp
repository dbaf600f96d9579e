// Kinematic chains compared with independently computed vectors and with poses derived by hand, forward and backward.

#include "machine/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/vector_rows.h"

namespace clsurf::kinematics_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

Kinematics machine_of(KinematicsType type, const std::string& kind) {
    Kinematics k;
    k.type = type;
    k.tilt = kind == "BC" ? RotaryAxis{'b', Vec3::UnitY(), 1} : RotaryAxis{'a', Vec3::UnitX(), 1};
    return k;
}

void expect_near(const Vec3& value, const Vec3& expected, double tolerance, const std::string& what) {
    EXPECT_LE((value - expected).cwiseAbs().maxCoeff(), tolerance)
        << what << ": " << value.transpose() << " for " << expected.transpose();
}

Vec3 vec(VectorRow& row) {
    const std::vector<double> n = row.numbers(3);
    return {n[0], n[1], n[2]};
}

TEST(Kinematics, AgreesWithIndependentVectors) {
    for (VectorRow& row : vector_rows("machine", "rotary_kinematics.txt")) {
        const std::string kind = row.word();
        RotaryAngles angles;
        angles.tilt = row.number();
        angles.rotation = row.number();
        const Vec3 tip = vec(row);
        Kinematics k = machine_of(KinematicsType::table_table, kind);
        k.rotation_centre = vec(row);
        k.centre_from_tilt = vec(row);
        k.tilt_point = vec(row);
        k.tilt_from_rotation = vec(row);
        const double tool = row.number();
        constexpr double tolerance = 1e-9;
        expect_near(k.axis_of(angles), vec(row), tolerance, row.name + " axis");
        expect_near(k.to_axes(tip, angles), vec(row), 2e-8, row.name + " table-table");  // printed to twelve digits
        k.tool_length = tool;
        k.type = KinematicsType::head_head;
        expect_near(k.to_axes(tip, angles), vec(row), 2e-8, row.name + " head-head");
        k.type = KinematicsType::table_head;
        expect_near(k.to_axes(tip, angles), vec(row), 2e-8, row.name + " table-head");
    }
}

// By hand: a trunnion whose A axis passes through the machine's zero, with the C centre 30 mm above it. With A at
// 90° the tool comes from −y: t = (sin 90 sin 0, −sin 90 cos 0, cos 90) = (0, −1, 0). The tip in the
// centre of C was at (0, 0, 30); T(−90°) about x maps z to y: (0, 30, 0).
TEST(Kinematics, TrunnionOnPaper) {
    Kinematics k = machine_of(KinematicsType::table_table, "AC");
    k.centre_from_tilt = {0, 0, 30};
    k.rotation_centre = {0, 0, 30};
    expect_near(k.to_axes({0, 0, 30}, {}), {0, 0, 30}, 1e-14, "level");
    expect_near(k.axis_of({90 * degree, 0}), {0, -1, 0}, 1e-15, "axis");
    expect_near(k.to_axes({0, 0, 30}, {90 * degree, 0}), {0, 30, 0}, 1e-13, "tilted");
    // A point 10 mm to +x of the centre, C turned by 90°: the table turns by −90°, to −y.
    expect_near(k.to_axes({10, 0, 30}, {0, 90 * degree}), {0, -10, 30}, 1e-13, "turned");
}

// A fork head with L = 200 and tilt B = 30°, C = 90°: t = (sin 30 cos 90, sin 30 sin 90, cos 30) =
// (0, 0.5, 0.866); the pivot is 200 mm along t above the tip.
TEST(Kinematics, ForkHeadOnPaper) {
    Kinematics k = machine_of(KinematicsType::head_head, "BC");
    k.tool_length = 200;
    const RotaryAngles angles{30 * degree, 90 * degree};
    expect_near(k.to_axes({1, 2, 3}, angles), {1, 102, 3 + 200 * std::sqrt(0.75)}, 1e-12, "pivot");
    const ToolPose pose = k.to_workpiece({1, 102, 3 + 200 * std::sqrt(0.75)}, angles);
    expect_near(pose.tip, {1, 2, 3}, 1e-12, "tip");
    expect_near(pose.axis, {0, 0.5, std::sqrt(0.75)}, 1e-15, "axis");
}

/// A machine of every type with random offsets; `inclined`: a tilt axis of 45° between y and z.
Kinematics random_machine(std::mt19937& random, KinematicsType type, int pair) {
    std::uniform_real_distribution<double> length(-200, 200);
    const auto any = [&] { return Vec3(length(random), length(random), length(random)); };
    Kinematics k;
    k.type = type;
    if (pair == 1) k.tilt = {'b', Vec3::UnitY(), 1};
    if (pair == 2) k.tilt = {'b', Vec3(0, 1, 1).normalized(), 1};
    if (pair == 3) k.rotation = {'b', Vec3::UnitY(), 1};
    k.rotation_centre = any();
    k.centre_from_tilt = any();
    k.tilt_point = any();
    k.tilt_from_rotation = any();
    k.tool_length = std::abs(length(random));
    return k;
}

TEST(Kinematics, ThereAndBackOverRandomPoses) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> length(-400, 400);
    std::uniform_real_distribution<double> angle(-pi, pi);
    for (int i = 0; i < 100'000; ++i) {
        const KinematicsType type = kinematics_types()[static_cast<std::size_t>(1 + i % 3)];
        const Kinematics k = random_machine(random, type, i % 4);
        const RotaryAngles angles{angle(random), angle(random)};
        const Vec3 tip(length(random), length(random), length(random));
        const Vec3 linear = k.to_axes(tip, angles);
        const ToolPose pose = k.to_workpiece(linear, angles);
        ASSERT_LE((pose.tip - tip).norm(), 1e-9) << name_of(type);
        ASSERT_NEAR(pose.axis.norm(), 1, 1e-12);
        // On a table-table machine, a move along the tool axis moves only the machine axis of the tool.
        if (type != KinematicsType::table_table) continue;
        const Vec3 lifted = k.to_axes(tip + 10 * pose.axis, angles);
        ASSERT_LE((lifted - linear - 10 * k.tool_axis).norm(), 1e-9);
    }
}

TEST(Kinematics, ASmallAngleMovesTheTipByItsLeverArm) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> length(-400, 400);
    std::uniform_real_distribution<double> angle(-pi, pi);
    constexpr double small = 1e-6;  // [rad]
    for (int i = 0; i < 1000; ++i) {
        const KinematicsType type = kinematics_types()[static_cast<std::size_t>(1 + i % 3)];
        const Kinematics k = random_machine(random, type, i % 4);
        const RotaryAngles at{angle(random), angle(random)};
        const Vec3 linear(length(random), length(random), length(random));
        const LeverArms arms = k.lever_arms(linear, at);
        const auto moved = [&](const RotaryAngles& to) {
            return (k.to_workpiece(linear, to).tip - k.to_workpiece(linear, at).tip).norm() / small;
        };
        ASSERT_NEAR(arms.tilt, moved({at.tilt + small, at.rotation}), 1e-3) << name_of(type);
        ASSERT_NEAR(arms.rotation, moved({at.tilt, at.rotation + small}), 1e-3) << name_of(type);
    }
}

TEST(Kinematics, BothSolutionsGiveTheAxis) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> angle(-pi, pi);
    for (int i = 0; i < 100'000; ++i) {
        const Kinematics k = random_machine(random, KinematicsType::head_head, i % 4);
        const RotaryAngles given{angle(random), angle(random)};
        const Vec3 axis = k.axis_of(given);
        const RotarySolutions found = solve_rotary(k, axis, {});
        ASSERT_GE(found.count, 1);
        bool met = false;
        for (int s = 0; s < found.count; ++s) {
            const RotaryAngles& angles = found.angles[static_cast<std::size_t>(s)];
            ASSERT_LE(angle_between(k.axis_of(angles), axis), 1e-9) << i << ' ' << given.tilt << ' ' << given.rotation;
            const double off = std::abs(std::remainder(angles.tilt - given.tilt, 2 * pi)) +
                               std::abs(std::remainder(angles.rotation - given.rotation, 2 * pi));
            met = met || off < 1e-7;
        }
        ASSERT_TRUE(met) << i << ' ' << given.tilt << ' ' << given.rotation;
    }
}

// The second solution of AC and BC: (−tilt, C + π).
TEST(Kinematics, SecondSolutionIsTheOppositeTilt) {
    for (const char* kind : {"AC", "BC"}) {
        const Kinematics k = machine_of(KinematicsType::table_table, kind);
        const RotarySolutions found = solve_rotary(k, k.axis_of({0.3, 1.1}), {});
        ASSERT_EQ(found.count, 2);
        EXPECT_NEAR(found.angles[0].tilt, 0.3, 1e-12);
        EXPECT_NEAR(found.angles[0].rotation, 1.1, 1e-12);
        EXPECT_NEAR(found.angles[1].tilt, -0.3, 1e-12);
        EXPECT_NEAR(found.angles[1].rotation, 1.1 - pi, 1e-12);
    }
}

TEST(Kinematics, AtThePoleTheRotationStays) {
    const Kinematics k = machine_of(KinematicsType::table_table, "AC");
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1e-12, 0, 1), Vec3(0, 0, -1)}) {
        const RotarySolutions found = solve_rotary(k, axis, {0.1, 2.5});
        EXPECT_TRUE(found.pole);
        ASSERT_EQ(found.count, 1);
        EXPECT_EQ(found.angles[0].rotation, 2.5);
        EXPECT_NEAR(std::abs(found.angles[0].tilt), axis.z() > 0 ? 0 : pi, 1e-9);
    }
    // Close to it the angles are exact to rounding; 1 − cos² would have lost them.
    const RotarySolutions near = solve_rotary(k, k.axis_of({1e-7, 0.8}), {});
    EXPECT_FALSE(near.pole);
    EXPECT_NEAR(near.angles[0].tilt, 1e-7, 1e-16);
    EXPECT_NEAR(near.angles[0].rotation, 0.8, 1e-9);
}

// A nutating head of 45° reaches from the pole to 90°, not farther.
TEST(Kinematics, WhatAnInclinedAxisCannotReach) {
    Kinematics k = machine_of(KinematicsType::head_head, "BC");
    k.tilt.direction = Vec3(0, 1, 1).normalized();
    EXPECT_EQ(solve_rotary(k, Vec3(0.6, 0, 0.8), {}).count, 2);
    EXPECT_EQ(solve_rotary(k, Vec3(0.6, 0, -0.8), {}).count, 0);
    EXPECT_NEAR(angle_between(k.axis_of({pi, 0}), Vec3::UnitZ()), pi / 2, 1e-12);
}

TEST(Kinematics, FollowingKeepsTurnsAndRanges) {
    const Kinematics k = machine_of(KinematicsType::table_table, "AC");
    const AngleRange free;
    const std::vector<Vec3> axes{k.axis_of({0.4, 0.2})};
    // Three turns farther: the same tool axis again changes nothing.
    std::vector<RotaryAngles> found = follow_rotary(k, axes, {0.4, 0.2 + 6 * pi}, free, free);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].rotation, 0.2 + 6 * pi, 1e-12);
    EXPECT_NEAR(found[0].tilt, 0.4, 1e-12);
    // Tilt may only be negative: the other branch.
    found = follow_rotary(k, axes, {0, 0}, {-pi / 2, 0}, free);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].tilt, -0.4, 1e-12);
    EXPECT_NEAR(found[0].rotation, 0.2 - pi, 1e-12);
    EXPECT_TRUE(follow_rotary(k, axes, {0, 0}, {-0.3, 0.3}, free).empty());
}

// Through the pole: a greedy choice turns C by half a turn; following the whole series continues to
// negative tilt. From tilt +0.5 to −0.5 in steps, C = 0.3 throughout.
TEST(Kinematics, FollowingGoesThroughThePole) {
    const Kinematics k = machine_of(KinematicsType::table_table, "AC");
    std::vector<Vec3> axes;
    for (int i = -50; i <= 50; ++i) axes.push_back(k.axis_of({-0.01 * i, 0.3}));
    const std::vector<RotaryAngles> path = follow_rotary(k, axes, {0.5, 0.3}, {}, {});
    ASSERT_EQ(path.size(), axes.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_NEAR(path[i].rotation, 0.3, 1e-9) << i;
        EXPECT_NEAR(path[i].tilt, 0.5 - 0.01 * static_cast<double>(i), 1e-9) << i;
    }
    // Tilt limited to 0 and above: C has to turn by π, without a jump of the tool axis.
    const std::vector<RotaryAngles> other = follow_rotary(k, axes, {0.5, 0.3}, {0, pi}, {});
    ASSERT_EQ(other.size(), axes.size());
    EXPECT_NEAR(std::abs(other.back().rotation - 0.3), pi, 1e-9);
    for (std::size_t i = 0; i < other.size(); ++i) EXPECT_LE(angle_between(k.axis_of(other[i]), axes[i]), 1e-9);
}

}  // namespace
}  // namespace clsurf::kinematics_test

// Corners without rounding, limited look-ahead and blocks of whole periods, compared with values computed by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "simulation/path/junction.h"
#include "simulation/plan/scurve.h"
#include "support/made_motion.h"

namespace clsurf::junction_test {
namespace {

/// Without a jerk limit, 500 mm/s² for the path, normal to it, and for each axis; corners by junction deviation.
Machine stepper() {
    Machine machine;
    machine.controller.period = 0.0001;
    machine.controller.corner = CornerMode::junction;
    machine.path = {.max_speed = 100, .max_acceleration = 500, .max_normal_acceleration = 500, .max_jerk = 1e9};
    for (MachineAxis& axis : machine.axes) axis.max_acceleration = 500, axis.max_jerk = 0;
    return machine;
}

TEST(Junction, DeviationGivesTheSpeedOfItsArc) {
    Machine machine = stepper();
    const Vec3 square(-1, 1, 0);
    // 90°: r = 0.01 · 0.70711/0.29289 = 0.024142, √(500 r).
    EXPECT_NEAR(junction_speed(square, machine), 3.47434, 1e-5);
    // Each axis has 500, so there is 500 √2 along (−1, 1).
    machine.path.max_normal_acceleration = 1e9;
    EXPECT_NEAR(junction_speed(square, machine), 4.131715, 1e-5);
    machine.axes[1].max_acceleration = 100;
    EXPECT_NEAR(junction_speed(square, machine), 4.131715 / std::sqrt(5.0), 1e-5);
    // Small angles: r = 8 δ/α².
    const double angle = 1e-6;
    EXPECT_NEAR(junction_speed({std::cos(angle) - 1, 0, std::sin(angle)}, machine) / std::sqrt(8 * 0.01 * 500),
                1 / angle, 1e-3 / angle);
    EXPECT_EQ(junction_speed({-2, 0, 0}, machine), 0);
    EXPECT_TRUE(std::isinf(junction_speed(Vec3::Zero(), machine)));
}

TEST(Junction, NoAxisSpeedStepsByMoreThanTheRule) {
    Machine machine = stepper();
    machine.controller.junction = {.deviation = 0, .speed_step = 3};
    EXPECT_NEAR(junction_speed({-1, 1, 0}, machine), 3, 1e-12);
    EXPECT_NEAR(junction_speed({-0.5, 0.25, 0.1}, machine), 6, 1e-12);
    machine.controller.junction.deviation = 0.01;  // 90°: 3.474, the lower one applies
    EXPECT_NEAR(junction_speed({-1, 1, 0}, machine), 3, 1e-12);
    machine.controller.junction.speed_step = 4;
    EXPECT_NEAR(junction_speed({-1, 1, 0}, machine), 3.47434, 1e-5);
}

constexpr const char* square_corner = "G21 G90 G1 X10 F600\nY10\nM2\n";

TEST(Junction, TwoLinesTakeTheTimeOnPaper) {
    // Each line: 0 → 10 mm/s, cruise, 10 → 3.474.
    const Recorded r = run_program(program_of(square_corner), stepper());
    const double corner = 3.47434, up = 10.0 / 500, down = (10 - corner) / 500;
    const double cruise = (10 - 0.5 * 10 * up - 0.5 * (10 + corner) * down) / 10;
    EXPECT_NEAR(r.summary.duration, 2 * (up + down + cruise), 2e-4);
    EXPECT_EQ(r.summary.path_deviation, 0);
    EXPECT_LE(r.summary.max_tangential_acceleration, 500 * 1.001);
    // Within a period of the corner the speed is at most a T above that of the rule.
    for (std::size_t k = 1; k < r.points.size(); ++k) {
        if (r.points[k - 1].commanded.y() == 0 && r.points[k].commanded.y() > 0) {
            EXPECT_NEAR(r.points[k].speed, corner, 500 * 0.0001);
        }
        EXPECT_TRUE(r.points[k].commanded.y() == 0 || std::abs(r.points[k].commanded.x() - 10) < 1e-12);
    }
}

TEST(Junction, WithAJerkLimitTheAccelerationIsZeroInTheCorner) {
    Machine machine = stepper();
    machine.path.max_jerk = 20000;
    const Recorded r = run_program(program_of(square_corner), machine);
    const double corner = 3.47434;
    const auto ramp = [](double change) { return change / 500 + 500.0 / 20000; };  // a²/j = 12.5: not reached below
    const auto short_ramp = [](double change) { return 2 * std::sqrt(change / 20000); };
    const auto time = [&](double change) { return change < 12.5 ? short_ramp(change) : ramp(change); };
    const double up = time(10), down = time(10 - corner);
    const double cruise = (10 - 0.5 * 10 * up - 0.5 * (10 + corner) * down) / 10;
    EXPECT_NEAR(r.summary.duration, 2 * (up + down + cruise), 2e-4);
    EXPECT_EQ(r.summary.path_deviation, 0);
}

TEST(Junction, ExactStopsRemain) {
    const Recorded passed = run_program(program_of(square_corner), stepper());
    const Recorded stopped = run_program(program_of(std::string("G61.1\n") + square_corner), stepper());
    const double corner = 3.47434;  // v²/(2 a) at v instead of 10: (10 − v)²/(2 a 10) is saved on each side
    const double saved = (100 - std::pow(10 - corner, 2)) / (2 * 500 * 10);
    EXPECT_NEAR(stopped.summary.duration - passed.summary.duration, 2 * saved, 3e-4);
}

/// Collinear blocks of 0.1 mm, with a feed that no look-ahead here can reach.
std::string short_lines() {
    std::string text = "G21 G90 G64 F6000\n";
    for (int k = 1; k <= 400; ++k) text += fmt::format("G1 X{:.1f}\n", 0.1 * k);
    return text + "M2\n";
}

TEST(Lookahead, ASpeedCanBrakeInTheBlocksThatAreKnown) {
    // With n blocks of length l known after the present one, its end has v² = 2 a n l; within a block it gains a l.
    for (const CornerMode corner : {CornerMode::junction, CornerMode::spline}) {
        Machine machine = stepper();
        machine.controller.corner = corner;
        machine.controller.lookahead_blocks = 5;
        machine.controller.replan_blocks = 1;
        const Recorded r = run_program(program_of(short_lines()), machine);
        EXPECT_NEAR(r.summary.max_speed, std::sqrt(2 * 500 * 0.5 + 500 * 0.1), 500 * 0.0001) << name_of(corner);
        EXPECT_TRUE(r.summary.limits_ok);
    }
}

TEST(Lookahead, ADistanceCountsLikeItsBlocks) {
    Machine machine = stepper();
    machine.controller.replan_blocks = 1;
    machine.controller.lookahead_distance = 0.45;  // the fifth block ends beyond it
    const Recorded by_distance = run_program(program_of(short_lines()), machine);
    machine.controller.lookahead_distance = 0;
    machine.controller.lookahead_blocks = 5;
    const Recorded by_blocks = run_program(program_of(short_lines()), machine);
    EXPECT_EQ(by_distance.summary.duration, by_blocks.summary.duration);
    // Long blocks are not slowed: the distance counts from the end of the present block.
    machine.controller.lookahead_blocks = 500;
    machine.controller.lookahead_distance = 2;
    const Recorded longer = run_program(program_of("G21 G90 G1 X20 F600\nX40\nX60\nM2\n"), machine);
    EXPECT_NEAR(longer.summary.duration, 60.0 / 10 + 10.0 / 500, 2e-4);
}

TEST(Lookahead, PlanningLaterKnowsLess) {
    Machine machine = stepper();
    machine.controller.lookahead_blocks = 6;
    double before = 0;
    for (const int blocks : {1, 2, 4, 6}) {
        machine.controller.replan_blocks = blocks;
        const double time = run_program(program_of(short_lines()), machine).summary.duration;
        EXPECT_GT(time, before) << blocks;
        before = time;
    }
}

TEST(WholePeriods, AFeedIsLoweredToAWholeNumberOfPeriods) {
    Machine machine = stepper();
    machine.controller.period = 0.01;
    machine.controller.whole_periods = true;
    const auto greatest = [&](double length) {
        std::string text = "G21 G90 G64 F600\n";
        for (int k = 1; k <= 100; ++k) text += fmt::format("G1 X{:.4f}\n", length * k);
        return run_program(program_of(text + "M2\n"), machine).summary.max_speed;
    };
    EXPECT_NEAR(greatest(0.25), 0.25 / 0.03, 1e-9);  // 2.5 periods at 10 mm/s
    EXPECT_NEAR(greatest(0.3), 10, 1e-9);
    EXPECT_NEAR(greatest(0.04), 4, 1e-9);  // 0.4 periods
}

}  // namespace
}  // namespace clsurf::junction_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/readers/machine_file.h"
#include "io/readers/program_file.h"
#include "simulation/path/junction.h"
#include "simulation/plan/scurve.h"
#include "simulation/run/recorder.h"
#include "support/made_motion.h"

namespace clsurf::simulator_test {
namespace {

Recorded run(const std::string& text, const Machine& machine) { return run_program(program_of(text), machine); }

/// A machine whose axes follow exactly.
Machine ideal() {
    Machine machine;
    for (MachineAxis& axis : machine.axes)
        axis.servo = {.position_gain = 100, .velocity_feedforward = 1, .velocity_time_constant = 0, .quantum = 0};
    return machine;
}

TEST(Simulator, ALineFromRestTakesTheTimeOnPaper) {
    // 100 mm at 50 mm/s with a = 2000, j = 50000: δ = 50 < a²/j = 80, ramps of 2 √(50/50000) s.
    const Recorded r = run("G21 G90 G1 X100 F3000\nM2\n", ideal());
    const double ramp = 2 * std::sqrt(50.0 / 50000.0);
    EXPECT_NEAR(r.summary.duration, 100.0 / 50.0 + ramp, 0.001);
    EXPECT_EQ(r.points.front().commanded, Vec3(0, 0, 0));
    EXPECT_EQ(r.points.back().commanded, Vec3(100, 0, 0));
    EXPECT_NEAR(r.summary.max_speed, 50, 1e-9);
    EXPECT_NEAR(r.summary.max_jerk.x(), 50000, 50);
    EXPECT_TRUE(r.summary.limits_ok);
}

/// A zigzag of 30 corners of 100 degrees, each rounded within 0.1 mm.
std::string zigzag() {
    std::string text = "G21 G90 G64 P0.1\nF600\n";
    for (int k = 1; k <= 30; ++k) text += fmt::format("G1 X{:.4f} Y{:.4f}\n", 0.8 * k, k % 2 == 1 ? 0.95 : 0.0);
    return text + "M2\n";
}

/// Only the path limits this machine: 100 mm/s² along it and normal to it.
Machine limited_by_the_path(double jerk) {
    Machine machine = ideal();
    machine.controller.period = 0.0005;
    machine.controller.corner = CornerMode::spline;
    machine.controller.chord_tolerance = 0.1;
    machine.path = {.max_speed = 10, .max_acceleration = 100, .max_normal_acceleration = 100, .max_jerk = jerk};
    for (MachineAxis& axis : machine.axes) axis.max_acceleration = 1e6, axis.max_jerk = 0;
    return machine;
}

TEST(Simulator, TheTangentialAccelerationKeepsToThePathsLimitInRoundedCorners) {
    for (const double jerk : {1e4, 1e6}) {  // the second is no limit
        const Machine machine = limited_by_the_path(jerk);
        const Recorded r = run(zigzag(), machine);
        // From the set points alone: the change of the distance covered in a period.
        double greatest = 0;
        for (std::size_t k = 2; k < r.points.size(); ++k) {
            const double before = (r.points[k - 1].commanded - r.points[k - 2].commanded).norm();
            const double after = (r.points[k].commanded - r.points[k - 1].commanded).norm();
            greatest = std::max(greatest, std::abs(after - before) / std::pow(machine.controller.period, 2));
        }
        EXPECT_LE(greatest, 100 * 1.001) << jerk;
        EXPECT_GT(greatest, 90) << jerk;
        EXPECT_NEAR(r.summary.max_tangential_acceleration, greatest, 1) << jerk;
        EXPECT_TRUE(r.summary.limits_ok) << jerk;
    }
}

/// A star with corners of 20 … 168°, long lines between them.
std::string star() {
    std::string text = "G21 G90 G64 P0.05\nG1 X5 F6000\n";
    double x = 5, y = 0, direction = 0;
    for (const double turn : {20.0, 168.0, -60.0, 144.0, -107.0, 137.0, 90.0, -162.0, 42.0}) {
        direction += turn * std::numbers::pi / 180;
        x += 4 * std::cos(direction), y += 4 * std::sin(direction);
        text += fmt::format("G1 X{:.6f} Y{:.6f}\n", x, y);
    }
    return text + "M2\n";
}

// Not only with respect to the programmed arc length: in sharp corners the rounded path is much shorter.
TEST(Simulator, ThePathsJerkHoldsOnTheRoundedPath) {
    for (const bool axes : {false, true}) {
        Machine machine = limited_by_the_path(60000);
        machine.controller.period = 0.0005;
        machine.path = {.max_speed = 100, .max_acceleration = 3000, .max_normal_acceleration = 3000, .max_jerk = 60000};
        if (axes)
            for (MachineAxis& axis : machine.axes) axis.max_acceleration = 3000, axis.max_jerk = 60000;
        const Recorded r = run(star(), machine);
        double greatest = 0;
        for (std::size_t k = 2; k < r.points.size(); ++k) {
            const double second = r.points[k].speed - 2 * r.points[k - 1].speed + r.points[k - 2].speed;
            greatest = std::max(greatest, std::abs(second) / std::pow(machine.controller.period, 2));
        }
        EXPECT_LE(greatest, 60000 * 1.001) << axes;
        EXPECT_GT(greatest, 60000 * 0.98) << axes;
        EXPECT_TRUE(r.summary.limits_ok) << axes;
        EXPECT_NEAR(r.summary.max_tangential_jerk, greatest, 1) << axes;
    }
}

// In bends the jerk of a path without limits of axes is v³k², with the curvature from the set points.
TEST(Simulator, WhereOnlyThePathLimitsTheJerkItDoesInBendsToo) {
    Machine machine = limited_by_the_path(60000);
    machine.controller.period = 0.0005;
    machine.path = {.max_speed = 100, .max_acceleration = 3000, .max_normal_acceleration = 3000, .max_jerk = 60000};
    const Recorded r = run("G21 G90 G64 P0.05\nG1 X5 F6000\nX9 Y2\nX12 Y6\nX16 Y7\nM2\n", machine);
    double greatest = 0;
    for (std::size_t k = 1; k + 1 < r.points.size(); ++k) {
        const Vec3 in = r.points[k].commanded - r.points[k - 1].commanded;
        const Vec3 out = r.points[k + 1].commanded - r.points[k].commanded;
        const double step = 0.5 * (in.norm() + out.norm());
        if (!(in.norm() > 1e-6 && out.norm() > 1e-6)) continue;
        const double curvature = deflection(in.normalized(), out.normalized()) / step;
        greatest = std::max(greatest, std::pow(step / machine.controller.period, 3) * curvature * curvature);
    }
    EXPECT_LE(greatest, 60000 * 1.002);
    EXPECT_GT(greatest, 60000 * 0.9);
}

TEST(Simulator, ATangentialAccelerationAboveThePathsLimitIsNoted) {
    const Program program = program_of("G21 G90 G1 X1\nM2\n");
    const Machine machine = limited_by_the_path(1e6);
    const PointSink sink = [](std::span<const SimulatedPoint>) {};
    for (const double acceleration : {99.0, 110.0}) {
        Recorder recorder(program, machine, Vec3::Zero(), sink);
        for (int k = 0; k < 50; ++k) {
            const double time = k * machine.controller.period;
            recorder.add({0.5 * acceleration * time * time, 0, 0}, acceleration * time, 1, LimitingFactor::none, 0);
        }
        EXPECT_EQ(recorder.finish().limits_ok, acceleration < 100) << acceleration;
    }
}

TEST(Simulator, LagOnALineIsSpeedTimesWhatFeedForwardLeavesOverGain) {
    Machine machine = ideal();
    machine.axes[0].servo = {
        .position_gain = 80, .velocity_feedforward = 0.9, .velocity_time_constant = 0.003, .quantum = 0};
    const Recorded r = run("G1 X100 F3000\nM2\n", machine);
    const SimulatedPoint& middle = r.points[1000];
    EXPECT_NEAR(middle.commanded.x() - middle.feedback.x(), 50 * (1 - 0.9) / 80, 1e-9);
    const Recorded exact = run("G1 X100 F3000\nM2\n", ideal());
    EXPECT_NEAR(exact.points[1000].feedback.x(), exact.points[1000].commanded.x(), 1e-9);
}

TEST(Simulator, FrictionAddsItsSpeedOverTheGainAndHoldsAfterAReversal) {
    Machine machine = ideal();
    machine.axes[0].servo = {
        .position_gain = 80, .velocity_feedforward = 1, .velocity_time_constant = 0.002, .quantum = 0, .friction = 2};
    const Recorded r = run("G1 X100 F3000\nX0\nM2\n", machine);
    const SimulatedPoint& middle = r.points[1000];
    EXPECT_NEAR(middle.commanded.x() - middle.feedback.x(), 2.0 / 80, 1e-9);
    int standing = 0;
    for (std::size_t i = 1; i < r.points.size(); ++i)
        standing += r.points[i].feedback.x() > 99 && r.points[i].feedback.x() == r.points[i - 1].feedback.x();
    EXPECT_GT(standing, 3);
    EXPECT_GT(r.points.back().feedback.x(), 0);  // friction stops it on the way back
    EXPECT_LT(r.points.back().feedback.x(), 2.0 / 80 + 0.01);
}

TEST(Simulator, BacklashIsLostOnceAReversal) {
    Machine machine = ideal();
    machine.axes[0].servo = {
        .position_gain = 100, .velocity_feedforward = 1, .velocity_time_constant = 0, .quantum = 0, .backlash = 0.02};
    const Recorded r = run("G1 X100 F3000\nX0\nM2\n", machine);
    EXPECT_NEAR(r.points[1000].commanded.x() - r.points[1000].feedback.x(), 0.01, 1e-9);
    const SimulatedPoint& back = r.points[r.points.size() - 1000];
    EXPECT_NEAR(back.commanded.x() - back.feedback.x(), -0.01, 1e-9);
}

TEST(Simulator, ACircleShrinksByTheGainOfTheLoop) {
    // Without feed-forward the loop is T_v s² + s + Kv: its gain at ω = v/R shrinks the radius.
    Machine machine = ideal();
    const double gain = 50, lag = 0.002;
    for (MachineAxis& axis : machine.axes)
        axis.servo = {.position_gain = gain, .velocity_feedforward = 0, .velocity_time_constant = lag, .quantum = 0};
    machine.controller.period = 0.0001;
    const Recorded r = run("G64 P0.01\nG1 X20 F3000\nG3 X20 Y0 I-20 J0 P3\nM2\n", machine);
    const double omega = 50.0 / 20.0;
    const double expected = 20 * gain / std::hypot(gain - lag * omega * omega, omega);
    double sum = 0;
    int count = 0;
    for (const SimulatedPoint& p : r.points) {
        if (p.line != 3 || std::abs(p.speed - 50) > 1e-6) continue;
        if (++count < 20000) continue;  // settled
        sum += p.feedback.norm();
    }
    ASSERT_GT(count, 40000);
    EXPECT_NEAR(sum / (count - 19999), expected, 0.02 * (20 - expected) + 1e-4);
}

TEST(Simulator, CornersStayInsideTheToleranceAndEndsAreExact) {
    const Recorded r = run("G64 P0.02\nG1 X10 F6000\nY10\nX0\nY0\nM2\n", ideal());
    EXPECT_LE(r.summary.path_deviation, 0.02);
    EXPECT_GT(r.summary.path_deviation, 0.018);  // a period rarely ends in the middle of a corner
    EXPECT_EQ(r.points.back().commanded, Vec3(0, 0, 0));
    for (std::size_t i = 100; i + 100 < r.points.size(); ++i) ASSERT_GT(r.points[i].speed, 0.1) << i;
}

// A right angle and a tolerance of 0.02 mm: r = e cos 45°/(1 − cos 45°) = 0.04828 mm, entered and left at √(a r).
// The speed on an arc with unequal radii follows its angle: the speed of its points is not that of the plan.
TEST(Simulator, ASpiralHasTheSpeedOfItsPoints) {
    const Machine machine;
    const Recorded r = run_program(program_of("G21 G17 G64 P0.01 F600\nG1 X5\nG3 X10.002 Y5 J5\nM2\n"), machine);
    int compared = 0;
    for (std::size_t i = 1; i < r.points.size(); ++i) {
        const SimulatedPoint &a = r.points[i - 1], &b = r.points[i];
        if (a.line != 3 || b.line != 3 || a.limit != LimitingFactor::feed || b.limit != LimitingFactor::feed) continue;
        ++compared;
        const double speed = (b.commanded - a.commanded).norm() / machine.controller.period;
        EXPECT_NEAR(0.5 * (a.speed + b.speed), speed, 2e-4);  // 10 mm/s, varying by up to 2e-3
    }
    EXPECT_GT(compared, 300);
}

TEST(Simulator, ACornerOfAnArcIsPassedAtTheLeastOfItsSpeeds) {
    Machine machine = ideal();
    machine.controller.corner = CornerMode::arc;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    machine.path.max_jerk =
        5e5;  // at a low one the fastest plan dips inside the arc, as it brakes and accelerates there
    machine.path.max_normal_acceleration = 400;
    machine.controller.chord_tolerance = 1;
    const double radius = 0.02 / (std::numbers::sqrt2 - 1);
    const Program program = program_of("G64 P0.02\nG1 X10 F6000\nY10\nM2\n");
    const auto greatest_on_arc = [&] {
        const Recorded r = run_program(program, machine);
        EXPECT_TRUE(r.summary.limits_ok);
        EXPECT_NEAR(r.summary.path_deviation, 0.02,
                    1e-9);  // from the corner to the arc; points leave the lines by r (1 − cos 45°)
        EXPECT_LE(greatest_distance(elements_of(program), r.points, 1, 5),
                  radius * (1 - std::numbers::sqrt2 / 2) + 1e-9);
        double greatest = 0;
        for (const SimulatedPoint& p : r.points) {
            if (p.commanded.x() > 10 - radius && p.commanded.y() < radius) greatest = std::max(greatest, p.speed);
        }
        return greatest;
    };
    EXPECT_NEAR(greatest_on_arc(), std::sqrt(400 * radius), 0.1);                         // 4.39 mm/s
    machine.controller.chord_tolerance = 1e-6;                                            // 2/T √(2 r E)
    EXPECT_NEAR(greatest_on_arc(), 2000 * std::sqrt(1e-6 * (2 * radius - 1e-6)), 0.001);  // 0.62 mm/s
    machine.controller.chord_tolerance = 1;
    machine.path.max_normal_acceleration = 1e6;
    machine.controller.period = 0.02;                                                         // one period in the arc
    EXPECT_LE(greatest_on_arc(), 2 * radius * std::sin(std::numbers::pi / 4) / 0.02 + 1e-9);  // 3.41 mm/s
}

TEST(Simulator, ExactPathStopsAtEveryCorner) {
    const Recorded r = run("G61\nG1 X1.2345 F6000\nY1\nM2\n", ideal());
    bool met = false;
    for (const SimulatedPoint& p : r.points) met = met || p.commanded == Vec3(1.2345, 0, 0);
    EXPECT_TRUE(met);
    EXPECT_EQ(r.summary.path_deviation, 0);
}

TEST(Simulator, ExactStopRestsAtTheEndOfEveryBlock) {
    // Straight on: an exact path passes through, an exact stop rests; G9 applies to one block.
    const auto rests = [](const std::string& text, const char* dialect) {
        const Recorded r = run_program(program_of(text, dialect), ideal());
        int count = 0;
        for (std::size_t i = 1; i + 1 < r.points.size(); ++i) {
            const double x = r.points[i].commanded.x();
            const bool at_end = std::abs(x - 2) < 1e-9 || std::abs(x - 4) < 1e-9;
            if (at_end && std::abs(r.points[i - 1].commanded.x() - x) < 1e-4) ++count;
        }
        return count;
    };
    const std::string line = "G1 X2 F6000\nX4\nX6\nM2\n";
    EXPECT_EQ(rests("G64\n" + line, "linuxcnc"), 0);
    EXPECT_EQ(rests("G61\n" + line, "linuxcnc"), 0);
    EXPECT_EQ(rests("G61.1\n" + line, "linuxcnc"), 2);
    EXPECT_EQ(rests("G0 X0 Y0 Z0\nG60\n" + line, "siemens"), 2);
    EXPECT_EQ(rests("G0 X0 Y0 Z0\nG64\nG1 X2 F6000\nX4 G9\nX6\nM2\n", "siemens"), 1);
}

TEST(Simulator, Cycle832GivesTheToleranceOfCorners) {
    const auto deviation = [](const std::string& modes) {
        const std::string text = "DEF REAL _TOL=0.05\nG0 X0 Y0 Z0\n" + modes + "G1 X10 F3000\nY10\nM30\n";
        return run_program(program_of(text, "siemens"), ideal()).summary.path_deviation;
    };
    EXPECT_NEAR(deviation("CYCLE832(_TOL,_FINISH,1)\n"), 0.05, 0.01);
    EXPECT_LE(deviation("CYCLE832(_TOL/10,1,1)\n"), 0.005);
    EXPECT_EQ(deviation("CYCLE832(_TOL,_FINISH,1)\nG60\n"), 0);
    EXPECT_EQ(deviation("CYCLE832(_TOL,_FINISH,1)\nCYCLE832()\n"), deviation(""));
}

TEST(Simulator, DwellsTakeTheirTime) {
    const double with = run("G1 X1 F600\nG4 P0.5\nX2\nM2\n", ideal()).summary.duration;
    const double stopping = run("G61\nG1 X1 F600\nX1 Y0.0000001\nX2 Y0\nM2\n", ideal()).summary.duration;
    EXPECT_NEAR(with - stopping, 0.5, 0.02);
}

TEST(Simulator, OverrideScalesTheFeed) {
    Machine machine = ideal();
    machine.controller.feed_override = 0.5;
    const Recorded r = run("G1 X50 F6000\nM2\n", machine);
    EXPECT_NEAR(r.summary.max_speed, 50, 1e-9);
    EXPECT_GT(r.summary.limited_by[static_cast<std::size_t>(LimitingFactor::feed_override)], 500);
}

TEST(Simulator, TheSameToTheBitAndWithoutALookAheadSlower) {
    std::string text = "G64 P0.01\n";
    for (int i = 0; i <= 2000; ++i) text += fmt::format("G1 X{:.4f} Y{:.4f} F6000\n", 0.05 * i, 5 * std::sin(0.01 * i));
    text += "M2\n";
    Machine machine = ideal();
    const Recorded a = run(text, machine);
    const Recorded b = run(text, machine);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) ASSERT_EQ(a.points[i].commanded, b.points[i].commanded);
    machine.controller.lookahead_blocks = 10;
    EXPECT_GT(run(text, machine).summary.duration, 1.5 * a.summary.duration);
}

// Feeds of collinear blocks that are exactly on one braking ramp: the ramp is then the optimum, and it
// passes every node with acceleration.
TEST(Simulator, CarriesAccelerationThroughNodes) {
    Machine machine = ideal();
    const PathLimits& path = machine.path;
    const double fast = 100, slow = 20;
    const double braking = ramp_distance(fast, slow, path.max_acceleration, path.max_jerk);
    const SCurve ramp =
        plan_scurve(braking, fast, slow, {fast, path.max_acceleration, path.max_acceleration, path.max_jerk}).profile;
    std::string text = fmt::format("G64\nG1 X50 F{}\n", fast * 60);
    constexpr int steps = 12;
    for (int k = 1; k <= steps; ++k) {
        const double begin = braking * (k - 1) / steps;
        text += fmt::format("X{:.12f} F{:.12f}\n", 50 + braking * k / steps,
                            60 * (k == 1 ? fast : ramp.at(ramp.time_at(begin)).speed));
    }
    const double time =
        run(text + fmt::format("X{:.12f} F{}\nM2\n", 50 + braking + 20, slow * 60), machine).summary.duration;
    const double optimum = (50 - ramp_distance(0, fast, path.max_acceleration, path.max_jerk)) / fast +
                           ramp_time(fast, path.max_acceleration, path.max_jerk) + ramp.duration() +
                           (20 - ramp_distance(slow, 0, path.max_acceleration, path.max_jerk)) / slow +
                           ramp_time(slow, path.max_acceleration, path.max_jerk);
    EXPECT_GT(time, optimum - 0.001);
    EXPECT_LT(time, 1.01 * optimum);
}

// The times of LinuxCNC, from the first to the last movement of the recorded logs [s].
TEST(Simulator, TakesAsLongAsLinuxCncWithItsRules) {
    const Machine machine = io::read_machine(SAMPLE_DATA "/machines/linuxcnc_logs.toml");
    const std::vector<std::pair<std::string, double>> recorded{{"bottle_zigzag.nc", 34.79},
                                                               {"bottle_uneven.nc", 27.21},
                                                               {"dome_loops.nc", 18.21},
                                                               {"transition_g61.nc", 28.86},
                                                               {"mixed.ngc", 21.31},
                                                               {"petal_loops_g64.ngc", 87.94},
                                                               {"petal_spiral.ngc", 83.86},
                                                               {"petal_zigzag_g64.ngc", 137.09},
                                                               {"petal_zigzag_irregular.ngc", 163.22}};
    for (const auto& [name, seconds] : recorded) {
        const Program program = io::read_program(io::open_source(SAMPLE_DATA "/programs/" + name),
                                                 {.dialect = "linuxcnc", .start = {}, .tools = {}});
        const SimulationSummary summary =
            simulate(program, machine, Vec3::Zero(), [](std::span<const SimulatedPoint>) {}, {});
        EXPECT_NEAR(summary.duration, seconds, 0.05 * seconds) << name;
    }
}

// 52.3 s with zero acceleration at every node.
TEST(Simulator, AZigzagUnderAJerkLimitIsNearItsOptimum) {
    const Program program = io::read_program(io::open_source(SAMPLE_DATA "/programs/bottle_zigzag.nc"),
                                             {.dialect = "linuxcnc", .start = {}, .tools = {}});
    const SimulationSummary summary =
        simulate(program, Machine{}, Vec3::Zero(), [](std::span<const SimulatedPoint>) {}, {});
    EXPECT_TRUE(summary.limits_ok);
    EXPECT_LT(summary.duration, 39.5);
}

// Without a jerk limit a bend of short lines is passed backward as it is passed forward, except for effects of the period.
TEST(Simulator, PassesABendBackAsForth) {
    Machine machine = ideal();
    machine.path.max_jerk = 2 * machine.path.max_acceleration / machine.controller.period;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    std::vector<std::string> bend;
    for (int i = -200; i <= 200; ++i)
        bend.push_back(
            fmt::format("G1 X{:.5f} Y{:.5f} F12000\n", 0.1 * i, 4 * std::exp(-0.0002 * (i - 30) * (i - 30))));
    const Recorded forth = run("G64\nG0 X-20\n" + fmt::format("{}", fmt::join(bend, "")) + "M2\n", machine);
    std::reverse(bend.begin(), bend.end());
    const Recorded back = run("G64\nG0 X20\n" + fmt::format("{}", fmt::join(bend, "")) + "M2\n", machine);
    EXPECT_TRUE(forth.summary.limits_ok && back.summary.limits_ok);
    const auto speed_at = [](const Recorded& r, double x) {
        std::size_t i = r.points.size() - 1;
        const bool behind = r.points[i].commanded.x() > x;
        while (i > 0 && (r.points[i - 1].commanded.x() > x) == behind) --i;
        return r.points[i].speed;
    };
    for (const double x : {-15.0, -8.0, -2.0, 0.0, 2.0, 3.0, 4.0, 6.0, 9.0, 16.0})
        EXPECT_NEAR(speed_at(forth, x), speed_at(back, x), 3) << x;
}

TEST(Simulator, DegenerateMovesKeepLimitsAndEnd) {
    const std::vector<std::pair<std::string, Vec3>> programs{
        {"G1 X0 F600\nX0 Y0\nX1\nX1\n", {1, 0, 0}},                          // no length, repeated
        {"G1 X5 F6000\nX2\nX5\nX4.9999\n", {4.9999, 0, 0}},                  // reversal
        {"G1 X1 F6000\nX0 Y0.000001\n", {0, 0.000001, 0}},                   // near reversal
        {"G1 X1 F6000\nG3 X1.002 Y0 R0.001\nG1 X2\n", {2, 0, 0}},            // an arc smaller than the tolerance
        {"G1 X0.00001 F6000\nY0.00001\nX0.00002\n", {0.00002, 0.00001, 0}},  // everything below resolution
        {"G2 X0 Y0 I0.5 P20 F9000\nG1 X-1 Z2\n", {-1, 0, 2}},                // many turns
        {"G1 X10 F0.5\nG1 X10.01 F90000\n", {10.01, 0, 0}},                  // feeds of very different size
    };
    for (const auto& [text, end] : programs) {
        const Recorded r = run("G64\n" + text + "M2\n", ideal());
        EXPECT_TRUE(r.summary.limits_ok) << text;
        EXPECT_LE(r.summary.path_deviation, 0.01) << text;
        EXPECT_LT((r.points.back().commanded - end).norm(), 1e-9) << text;
        for (const SimulatedPoint& p : r.points)
            ASSERT_TRUE(p.commanded.allFinite() && p.feedback.allFinite() && std::isfinite(p.speed)) << text;
    }
}

TEST(Simulator, ABlockTimeHoldsShortBlocksBack) {
    std::string text = "G64\n";
    for (int k = 1; k <= 1000; ++k) text += fmt::format("G1 X{:.2f} F6000\n", 0.05 * k);
    Machine machine = ideal();
    machine.controller.block_time = 0.005;
    const Recorded r = run(text + "M2\n", machine);
    EXPECT_NEAR(r.summary.max_speed, 0.05 / 0.005, 1e-6);
    EXPECT_GT(r.summary.limited_by[static_cast<std::size_t>(LimitingFactor::block_time)], 4000);
}

// From 47.27 mm/s a distance of 7.58e-7 mm gains 3.5e-12 mm/s, 500 times the rounding error of the speed itself, so that
// the distance of its ramp is known to 0.05 %.
TEST(Simulator, ASpeedReachedOverHardlyAnyArcLengthIsPlanned) {
    const double arc_length = 7.58264e-07, jerk = 50000, acceleration = 2000, before = 47.273111160212636;
    const double after = reach(before, arc_length, acceleration, jerk);
    for (const auto& [from, to] :
         {std::pair{before, after}, std::pair{after, before}, std::pair{47.273111160215855, before}}) {
        const PlannedProfile plan = plan_scurve(arc_length, from, to, {100, acceleration, acceleration, jerk});
        EXPECT_EQ(plan.status, ProfileStatus::ok);
        EXPECT_EQ(plan.profile.length(), arc_length);
    }
}

TEST(Simulator, FeedsThatDifferFromBlockToBlockAreFollowed) {
    // 150 mm of 0.04 mm blocks, 2850 ± 150 mm/min over 63 of them: these need v v′ = 300 mm/s² and v² v″ = 35,000 mm/s³, and
    // the limits are 2000 and 50,000. Windows of the look-ahead end anywhere on rising and falling feeds.
    constexpr int blocks = 3750;
    const auto feed = [](int k) { return std::round(2850 + 150 * std::sin(0.1 * k)); };
    std::string text = "G21 G90 G94 G64 P0.005\nG0 X0\n";
    for (int k = 0; k < blocks; ++k) text += fmt::format("G1 X{:.2f} F{}\n", 0.04 * (k + 1), feed(k));
    const Recorded r = run(text + "M2\n", ideal());
    constexpr LineNumber first_block = 3;
    constexpr std::size_t ramps = 200;  // points
    double slowest = 1;
    for (std::size_t i = ramps; i + ramps < r.points.size(); ++i) {
        const SimulatedPoint& p = r.points[i];
        slowest = std::min(slowest, 60 * p.speed / feed(static_cast<int>(p.line - first_block)));
    }
    EXPECT_GT(slowest, 0.97);
    EXPECT_TRUE(r.summary.limits_ok);
    EXPECT_EQ(r.points.back().commanded, Vec3(0.04 * blocks, 0, 0));
}

TEST(Simulator, RefusesWhatItCannotRun) {
    EXPECT_THROW(run("G1 X1 A5 F100\nM2\n", ideal()), InputError);
    EXPECT_THROW(run("G1 X1 F0\nM2\n", ideal()), InputError);
}

}  // namespace
}  // namespace clsurf::simulator_test

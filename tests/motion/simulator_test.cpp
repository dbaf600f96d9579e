#include "motion/simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "core/error.h"
#include "io/program_file.h"

namespace clsurf {
namespace {

struct Recorded {
    std::vector<SimulatedPoint> points;
    SimulationSummary summary;
};

Recorded run(const std::string& text, const Machine& machine) {
    auto kept = std::make_shared<const std::string>(text);
    io::Source source{"made.ngc", std::as_bytes(std::span(kept->data(), kept->size())), kept};
    const Program program = io::read_program(source, {.dialect = "linuxcnc", .tools = {}});
    Recorded recorded;
    recorded.summary = simulate(program, machine, Vec3::Zero(), [&](std::span<const SimulatedPoint> p) { recorded.points.insert(recorded.points.end(), p.begin(), p.end()); }, {});
    return recorded;
}

/// A machine whose axes follow exactly.
Machine ideal() {
    Machine machine;
    for (MachineAxis& axis : machine.axes) axis.servo = {100, 1, 0, 0, 0};
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

TEST(Simulator, LagOnALineIsSpeedTimesWhatFeedForwardLeavesOverGain) {
    Machine machine = ideal();
    machine.axes[0].servo = {80, 0.9, 0.003, 0, 0};
    const Recorded r = run("G1 X100 F3000\nM2\n", machine);
    const SimulatedPoint& middle = r.points[1000];
    // One period passes between a command and the position that answers it.
    const double lag = middle.commanded.x() - 50 * 0.001 - middle.feedback.x();
    EXPECT_NEAR(lag, 50 * (1 - 0.9) / 80 - 0.001 * 50 * 0, 0.001 * 50 + 1e-9);
    const Recorded exact = run("G1 X100 F3000\nM2\n", ideal());
    EXPECT_NEAR(exact.points[1000].feedback.x(), exact.points[1000].commanded.x(), 1e-9);
}

TEST(Simulator, ACircleShrinksByTheGainOfTheLoop) {
    // Without feed-forward the loop is T_v s² + s + Kv: its gain at ω = v/R shrinks the radius.
    Machine machine = ideal();
    const double gain = 50, lag = 0.002;
    for (MachineAxis& axis : machine.axes) axis.servo = {gain, 0, lag, 0, 0};
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
    EXPECT_GT(r.summary.path_deviation, 0.019);
    EXPECT_EQ(r.points.back().commanded, Vec3(0, 0, 0));
    for (std::size_t i = 100; i + 100 < r.points.size(); ++i) ASSERT_GT(r.points[i].speed, 0.1) << i;
}

TEST(Simulator, ExactPathStopsAtEveryCorner) {
    const Recorded r = run("G61\nG1 X1.2345 F6000\nY1\nM2\n", ideal());
    bool met = false;
    for (const SimulatedPoint& p : r.points) met = met || p.commanded == Vec3(1.2345, 0, 0);
    EXPECT_TRUE(met);
    EXPECT_EQ(r.summary.path_deviation, 0);
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
    EXPECT_GT(r.summary.ruled[static_cast<std::size_t>(Ruling::feed_override)], 500);
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

TEST(Simulator, RefusesWhatItCannotRun) {
    EXPECT_THROW(run("G1 X1 A5 F100\nM2\n", ideal()), InputError);
    EXPECT_THROW(run("G1 X1 F0\nM2\n", ideal()), InputError);
}

// Random programs on random machines: every limit holds when the points are differentiated, the path
// stays inside its tolerance, nothing is NaN and the end is exact.
TEST(Simulator, LimitsHoldForRandomProgramsOnRandomMachines) {
    std::mt19937_64 random(20260721);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const auto spread = [&](double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); };
    for (int round = 0; round < 300; ++round) {
        Machine machine;
        machine.controller.period = spread(0.0005, 0.004);
        machine.controller.tolerance = spread(0.001, 0.2);
        machine.controller.lookahead_blocks = static_cast<int>(spread(2, 300));
        machine.path = {spread(20, 500), spread(200, 5000), spread(200, 5000), spread(5000, 200000)};
        for (MachineAxis& axis : machine.axes) {
            axis.max_speed = spread(20, 500);
            axis.max_acceleration = spread(200, 5000);
            axis.max_jerk = spread(5000, 200000);
        }
        const double scale = spread(0.01, 20);
        std::string text = uniform(0, 1) < 0.15 ? "G61\n" : "G64\n";
        Vec3 at = Vec3::Zero();
        for (int block = 0; block < 60; ++block) {
            const double kind = uniform(0, 1);
            Vec3 to = at + scale * spread(0.02, 1) * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (kind < 0.05) to = at;
            if (kind > 0.95) text += fmt::format("G4 P{:.3f}\n", uniform(0, 0.02));
            if (kind < 0.7) {
                text += fmt::format("G{} X{:.6f} Y{:.6f} Z{:.6f} F{:.1f}\n", kind < 0.6 ? 1 : 0, to.x(), to.y(), to.z(), spread(50, 20000));
            } else {
                const double radius = 0.5 * std::hypot(to.x() - at.x(), to.y() - at.y()) * spread(1.01, 5);
                text += fmt::format("G{} X{:.6f} Y{:.6f} Z{:.6f} R{:.6f} F{:.1f}\n", kind < 0.8 ? 2 : 3, to.x(), to.y(), to.z(), radius, spread(50, 20000));
            }
            at = to;
        }
        const Recorded r = run(text + "M2\n", machine);
        const Vec3 end = r.points.back().commanded;
        const bool fine = r.summary.limits_ok && r.summary.path_deviation <= machine.controller.tolerance * (1 + 1e-9);
        ASSERT_TRUE(fine) << "round " << round << " deviation " << r.summary.path_deviation << " of " << machine.controller.tolerance << "\n" << text;
        ASSERT_TRUE((end - at).norm() < 1e-5) << round;
        for (const SimulatedPoint& p : r.points) ASSERT_TRUE(p.commanded.allFinite() && p.feedback.allFinite()) << round;
    }
}

}  // namespace
}  // namespace clsurf

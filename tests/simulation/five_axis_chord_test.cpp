// The chord error of a period where the tip nearly reverses, on five axes: it is met, and limits no more than necessary.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "io/readers/machine_file.h"
#include "simulation/plan/five_axis_limits.h"
#include "simulation/run/five_axis_simulator.h"
#include "support/made_five_axis.h"
#include "toolpath/tip_motions.h"

namespace clsurf::five_axis_chord_test {
namespace {

constexpr double width = 10;    ///< width of the zigzag [mm]
constexpr double across = 0.1;  ///< distance between lines [mm]

Machine machine_at(double period) {
    Machine machine = io::read_machine(SAMPLE_DATA "/machines/five_axis_trunnion.toml");
    machine.controller.period = period;
    return machine;
}

// The rounding of a corner has (15/16)(1 − x²)²/w of the jump s of the slope as its second derivative, x = d/w, and its
// distance from the corner is 15/96 w s, the tolerance: in the corner the second derivative is (15/16)(15/96) s²/tolerance.
TEST(FiveAxisChord, ANearReversalIsLimitedByItsSecondDerivative) {
    const Machine machine = machine_at(0.004);
    const ControllerSettings& c = machine.controller;
    FiveAxisChord out, back;
    out.end << width, across, 0, 0, 0;
    back.end << 0, 2 * across, 0, 0, 0;
    out.feed = back.feed = std::numeric_limits<double>::infinity();
    out.tolerance = back.tolerance = c.tolerance;
    const FiveAxisPath path(machine.kinematics, Vec3::Zero(), FiveAxes::Zero(), {out, back});
    const double length = std::hypot(width, across), jump = 2 * width / length;
    const double second = 15.0 / 16 * 15 / 96 * jump * jump / c.tolerance;
    const LimitPlace corner = FiveAxisLimits(path, machine).at(length);
    EXPECT_EQ(corner.why, LimitingFactor::chord_error);
    EXPECT_NEAR(corner.free_cap, std::sqrt(8 * c.chord_tolerance / second) / c.period, 1e-6);
}

struct ZigzagRun {
    double duration = 0;   ///< [s]
    double least_end = 0;  ///< smallest x of the outer reversals of the tip [mm]
};

/// Eight lines back and forth, each `across` farther, while the tool tilts.
ZigzagRun zigzag(double period) {
    const Machine machine = machine_at(period);
    std::string text = "G21 G90 G94 G17\nG43.4 H1\nG0 X0 Y0 Z0 A0 C0\nG1 F3000\n";
    for (int i = 1; i <= 8; ++i) text += fmt::format("X{:.1f} Y{:.1f} A{}\n", width * (i % 2), across * i, i % 2);
    Program program = test::parse_text(text + "G49\nM30\n");
    solve_tool_axes(program, machine);
    make_tip_motions(program, machine.kinematics, Vec3::Zero(), Vec3::Zero());
    ZigzagRun run{0, width};
    double farthest = 0;
    const auto see = [&](std::span<const FiveAxisPoint> points) {
        for (const FiveAxisPoint& point : points) {
            const auto& p = point.commanded;
            const double x = machine.kinematics.to_workpiece({p[0], p[1], p[2]}, {p[3], p[4]}).tip.x();
            farthest = std::max(farthest, x);
            if (x > 0.5 * width || farthest < 0.5 * width) continue;
            run.least_end = std::min(run.least_end, farthest);
            farthest = 0;
        }
    };
    const FiveAxisSummary summary = simulate_five_axis(program, machine, Vec3::Zero(), Vec3::Zero(), see, {});
    EXPECT_TRUE(summary.run.limits_ok) << period;
    run.duration = summary.run.duration;
    return run;
}

TEST(FiveAxisChord, ALongerPeriodIsHardlySlowerWhereTheTipNearlyReverses) {
    const ZigzagRun fine = zigzag(0.0005), coarse = zigzag(0.004);
    EXPECT_NEAR(coarse.duration, fine.duration, 0.01 * fine.duration);
    const ControllerSettings& c = machine_at(0.004).controller;
    // The tip is off the corner by at most the tolerance of its rounding plus the chord error of a period.
    EXPECT_GE(coarse.least_end, width - c.tolerance - c.chord_tolerance);
}

}  // namespace
}  // namespace clsurf::five_axis_chord_test

// The rules of a simulated planner are identified, and rules that the runs do not show are not changed.

#include "identify/planner_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "identify/rule_list.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"
#include "simulation/path/block_merging.h"

namespace clsurf::planner_rules_test {
namespace {

/// A zigzag over waves with a cluster of short lines on every third pass.
Program crowded_waves() {
    return read_text(
        wavy_zigzag(6, 20, [](int pass, double x) { return pass % 3 == 0 && x > 8 && x < 10 ? 0.03 : 0.3; }));
}

Part run_on(const Machine& machine, const Program& program = crowded_waves()) {
    return assemble(program, simulate_to_log(program, machine, Vec3::Zero()).log);
}

Identification identified(const Part& part, const Machine& known) {
    Identification result;
    result.machine = known;
    const RecordedRun run(part);
    EXPECT_TRUE(identify_rules({&run, 1}, result));
    return result;
}

const RuleCandidate* chosen(const Identification& result, std::string_view rule) {
    const auto found = std::find_if(result.rules.begin(), result.rules.end(),
                                    [&](const RuleCandidate& c) { return c.rule == rule && c.chosen; });
    return found == result.rules.end() ? nullptr : &*found;
}

TEST(PlannerRules, ATrapezoidalPlannerIsToldFromATimeOptimalOne) {
    Machine real;
    real.controller.planner = PlannerKind::trapezoidal;
    for (MachineAxis& axis : real.axes) axis.max_jerk = 0;
    Machine known = real;
    known.controller.planner = PlannerKind::time_optimal;
    const Part part = run_on(real);
    const Identification result = identified(part, known);
    EXPECT_EQ(result.machine.controller.planner, PlannerKind::trapezoidal);
    const RuleCandidate* last = chosen(result, "blocks_per_period");
    ASSERT_NE(last, nullptr);
    EXPECT_LT(last->speed_error, 0.1) << "mm/s";
}

// The first rules alone would be mistaken for a look-ahead of 20 blocks.
TEST(PlannerRules, ABlockTimeBetweenTheTriedOnesIsFound) {
    Machine real, known;
    real.controller.block_time = 0.004;
    const Part part = run_on(real);
    const Identification result = identified(part, known);
    EXPECT_NEAR(result.machine.controller.block_time, 0.004, 0.0002);
    EXPECT_GE(result.machine.controller.lookahead_blocks, 200) << "enough for every place of this part";
}

// 5 blocks are far too few, and 20 explain the run no better than 1000.
TEST(PlannerRules, AShortLookAheadIsFound) {
    Machine real;
    real.controller.planner = PlannerKind::trapezoidal;
    real.controller.trapezoid.max_feed_override = 2;
    real.path.max_acceleration = real.path.max_normal_acceleration = 1'000'000;
    for (MachineAxis& axis : real.axes) axis.max_jerk = 0;
    Machine known = real;
    real.controller.lookahead_blocks = 7;
    std::string text = wavy_zigzag(6, 20, [](int, double) { return 0.08; });
    text.replace(text.find("G64 P0.005"), 10, "G64 P0.005 Q0");  // no line is merged
    const Part part = run_on(real, read_text(text));
    EXPECT_EQ(identified(part, known).machine.controller.lookahead_blocks, 7);
}

/// Lines of 0.12 mm over waves, which the program does not allow to be merged.
Program short_lines() {
    std::string text = wavy_zigzag(6, 20, [](int, double) { return 0.12; });
    text.replace(text.find("G64 P0.005"), 10, "G64 P0.02 Q0");
    return read_text(text);
}

TEST(PlannerRules, LinesThatTheControllerMergesAreFound) {
    Machine real;
    real.controller.planner = PlannerKind::trapezoidal;
    real.path.max_acceleration = real.path.max_normal_acceleration = 1'000'000;
    for (MachineAxis& axis : real.axes) axis.max_jerk = 0;
    const Machine known = real;
    real.controller.merging_tolerance = 0.004;
    const Program program = short_lines();
    ASSERT_LT(merged_lines(program, real).size(), merged_lines(program, known).size() * 7 / 10);
    const Identification merging = identified(run_on(real, program), known);
    EXPECT_EQ(merging.machine.controller.merging_tolerance, 0.004);
    // Without merging, the program's Q of 0 explains the run as well as a machine that never merges.
    const Identification plain = identified(run_on(known, program), known);
    EXPECT_EQ(plain.machine.controller.merging_tolerance, std::nullopt);
    ASSERT_NE(chosen(plain, "merging_tolerance"), nullptr);
    EXPECT_EQ(chosen(plain, "merging_tolerance")->value, "program");
}

/// Three polygons of 36 corners of 10° each.
Program polygons() {
    std::string text = "G21 G90 G17 G64\nG0 X0 Y0 Z0\nF3000\n";
    for (int round = 0; round < 3; ++round) {
        for (int k = 0; k <= 36; ++k) {
            const double angle = k * std::numbers::pi / 18, radius = 10 + 0.3 * round;
            text += fmt::format("G1 X{:.4f} Y{:.4f} Z0\n", radius * std::sin(angle), radius * (1 - std::cos(angle)));
        }
    }
    return read_text(text + "M2\n");
}

// At F3000 a corner of 10° would change the speed of an axis by up to 523 mm/min. 400 mm/min is not among the tried values.
TEST(PlannerRules, TheSpeedStepOfCornersThatAreNotRoundedIsFound) {
    Machine real;
    real.controller.corner = CornerMode::junction;
    real.controller.junction = {.deviation = 0, .speed_step = 400 / seconds_per_minute};
    for (MachineAxis& axis : real.axes) axis.max_jerk = 0;
    Machine known = real;
    known.controller.corner = CornerMode::arc;
    known.controller.junction = {};
    const Part part = run_on(real, polygons());
    const Identification result = identified(part, known);
    EXPECT_EQ(result.machine.controller.corner, CornerMode::junction);
    EXPECT_NEAR(result.machine.controller.junction.speed_step * seconds_per_minute, 400, 8);
}

TEST(PlannerRules, FeedsByConstantSpeedIntervalsAreFound) {
    Machine real, known;
    real.controller.feed = FeedRule::intervals;
    const Part part = run_on(real);
    const Identification result = identified(part, known);
    EXPECT_EQ(result.machine.controller.feed, FeedRule::intervals);
}

// Between an arc of the XZ plane and a step-over along Y no arc is possible: these blocks overlap, each with half of the acceleration,
// although the planner joins other blocks by arcs.
TEST(PlannerRules, AnAccelerationOfWhichSomeBlocksShowHalfIsFound) {
    Machine real;
    real.controller.planner = PlannerKind::trapezoidal;
    real.path.max_acceleration = real.path.max_normal_acceleration = no_path_limit;
    for (MachineAxis& axis : real.axes) axis.max_jerk = 0, axis.max_acceleration = 3000;
    std::string text = "G21 G90 G18\nG64 P0.01\nF3000\nG1 X0 Y0 Z0\n";
    for (int pass = 0; pass < 8; ++pass) {
        const bool out = pass % 2 == 0;
        for (int k = 1; k <= 6; ++k)
            text += fmt::format("{} X{} Z0 R{}\n", k % 2 == 0 ? "G2" : "G3", out ? 4 * k : 24 - 4 * k, 8 + 2 * k);
        text += fmt::format("G1 Y{}\n", 0.8 * (pass + 1));
    }
    const Part part = run_on(real, read_text(text + "M30\n"));
    Identification result;
    result.machine = real;
    result.machine.axes[1].max_acceleration = 1500;
    result.parameters = {{"max_acceleration", "y", 1500, "mm/s²", 1.0, true, "", 1500}};
    const RecordedRun run(part);
    ASSERT_TRUE(identify_rules({&run, 1}, result));
    EXPECT_DOUBLE_EQ(result.machine.axes[1].max_acceleration, 3000);
    EXPECT_DOUBLE_EQ(result.parameters.front().value, 3000);
}

TEST(PlannerRules, WhatTheRunDoesNotShowKeepsItsValueAndIsNamed) {
    Machine real;
    const Part part = run_on(real);
    const Identification result = identified(part, real);
    // No corner is sharp enough for the tolerance to matter.
    EXPECT_EQ(result.machine.controller.tolerance, real.controller.tolerance);
    EXPECT_TRUE(std::any_of(result.unidentified.begin(), result.unidentified.end(),
                            [](const UnidentifiedParameter& p) { return p.name == "tolerance"; }));
    EXPECT_EQ(result.machine.controller.lookahead_blocks, 500);
    EXPECT_DOUBLE_EQ(result.machine.controller.block_time, 0);
}

}  // namespace
}  // namespace clsurf::planner_rules_test

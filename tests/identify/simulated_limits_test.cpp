// Limits that the motion does not show are found by simulation, and limits without effect are not changed.

#include "identify/simulated_limits.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "machine/planning_value.h"
#include "pipeline/simulated_log.h"
#include "repair/parts.h"

namespace clsurf::simulated_limits_test {
namespace {

/// Blocks overlap, and each has half of the acceleration: no axis stays at its limit.
Machine overlapping() {
    Machine machine;
    machine.controller.planner = PlannerKind::trapezoidal;
    machine.controller.trapezoid.arc_blends = false;
    machine.path.max_acceleration = machine.path.max_normal_acceleration = 1'000'000;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    machine.axes[0].max_acceleration = 1200;
    machine.axes[2].max_acceleration = 800;
    return machine;
}

Part waves_on(const Machine& machine, double height = 0.8) {
    const Program program = read_text(wavy_zigzag(
        4, 20, [](int, double) { return 0.3; }, height));
    return assemble(program, simulate_to_log(program, machine, Vec3::Zero()).log);
}

struct Searched {
    Identification result;
    std::vector<SimulatedLimit> limits;
};

/// The result of simulations for the acceleration of an axis or of the path; the motion shows `bound` [mm/s²].
Searched searched(const Part& part, const Machine& known, const char* of, double bound) {
    const RecordedRun run(part);
    RuleScores scores({&run, 1});
    Searched found;
    found.result.machine = known;
    found.result.parameters = {{"max_acceleration", of, bound, "mm/s²", {}, false, "", bound}};
    search_limits(0, scores, found.result);
    found.limits = limit_intervals(scores, found.result);
    state_limits(found.limits, found.result);
    return found;
}

/// The acceleration of an axis, for a machine file with the value `now`.
IdentifiedParameter found_from(const Part& part, const char* axis, double now) {
    Machine known = overlapping();
    set_planning_value(known, "max_acceleration", axis, now);
    const Identification result = searched(part, known, axis, 300).result;
    EXPECT_DOUBLE_EQ(*planning_value(result.machine, "max_acceleration", axis), result.parameters.front().value);
    return result.parameters.front();
}

TEST(SimulatedLimits, AccelerationsOfBlocksThatOverlapAreFound) {
    const Part gentle = waves_on(overlapping()), steep = waves_on(overlapping(), 2);
    for (const IdentifiedParameter& p : {found_from(gentle, "x", 1300), found_from(gentle, "x", 900)}) {
        ASSERT_TRUE(p.standard_error);
        EXPECT_TRUE(*p.reached);
        EXPECT_NEAR(p.value, 1200, std::min(3 * *p.standard_error, 12.0));
    }
    for (const IdentifiedParameter& p : {found_from(steep, "z", 1000), found_from(steep, "z", 2500)}) {
        ASSERT_TRUE(p.standard_error);
        EXPECT_NEAR(p.value, 800, std::min(3 * *p.standard_error, 8.0));
    }
}

// Few places show the acceleration of X, and the values that explain the run to the resolution of a model differ by several
// percent.
TEST(SimulatedLimits, OfTheValuesThatExplainARunTheBestRoundOneIsTaken) {
    Machine real = overlapping();
    real.controller.trapezoid.arc_blends = true;
    real.controller.period = 0.002;
    real.axes[0].max_acceleration = 4000;
    real.axes[1].max_acceleration = 3000;
    real.axes[2].max_acceleration = 2500;
    const Part part = waves_on(real);
    for (const double now : {3930.0, 4270.0}) {
        Machine known = real;
        known.axes[0].max_acceleration = now;
        const Identification result = searched(part, known, "x", 3900).result;
        const IdentifiedParameter& x = result.parameters.front();
        ASSERT_TRUE(x.standard_error) << now;
        EXPECT_DOUBLE_EQ(x.value, 4000) << now;
        EXPECT_DOUBLE_EQ(result.machine.axes[0].max_acceleration, 4000) << now;
    }
}

// The axes are slower than the path.
TEST(SimulatedLimits, ALimitThatIsOnlyBoundedFromBelowKeepsItsValue) {
    Machine known = overlapping();
    known.path.max_acceleration = 50'000;
    const auto& [result, limits] = searched(waves_on(overlapping()), known, "path", 300);
    ASSERT_EQ(limits.size(), 1U);
    EXPECT_TRUE(limits[0].explains);
    EXPECT_FALSE(limits[0].highest);
    ASSERT_TRUE(limits[0].lowest);
    EXPECT_DOUBLE_EQ(result.machine.path.max_acceleration, 50'000);
    EXPECT_GT(result.parameters[0].value, 300) << "with less the simulation would be slower";
    EXPECT_EQ(result.parameters[0].reached, false);
    EXPECT_FALSE(result.parameters[0].standard_error);
}

TEST(SimulatedLimits, AModelThatDoesNotExplainTheRunGivesNoStandardError) {
    Machine known = overlapping();
    known.controller.trapezoid.arc_blends = true;
    const Identification result = searched(waves_on(overlapping()), known, "x", 500).result;
    EXPECT_FALSE(result.parameters[0].standard_error);
    EXPECT_EQ(result.parameters[0].reached, false);
}

// Two limits of the known path are too low, so that either value alone explains little more.
TEST(SimulatedLimits, LimitsThatHoldBackTheSimulationTogetherAreFreedTogether) {
    Machine real;
    real.path.max_acceleration = 5000;
    real.path.max_jerk = 400'000;
    for (MachineAxis& axis : real.axes) axis.max_acceleration = 1000, axis.max_jerk = 30'000;
    const Part part = waves_on(real, 2);
    const RecordedRun run(part);
    RuleScores scores({&run, 1});
    Identification result;
    result.machine = real;
    result.machine.path.max_acceleration = 700;
    result.machine.path.max_jerk = 20'000;
    result.parameters = {{"max_acceleration", "path", 650, "mm/s²", {}, false, "", 650},
                         {"max_jerk", "path", 18'000, "mm/s³", {}, false, "", 18'000}};
    const auto error = [&] { return compare({scores.residuals(result.machine)}, scores).front().speed_error; };
    ASSERT_GT(error(), 10 * scores.resolution());
    free_limits(scores, result);
    EXPECT_TRUE(scores.explains(error()));
    EXPECT_GT(result.machine.path.max_acceleration, 700);
    EXPECT_GT(result.machine.path.max_jerk, 20'000);
}

/// Passes of flat arcs in the XZ plane, with `in_xy` also of arcs in the XY plane. Blocks overlap, so that each has half of
/// 800 mm/s². At 120 mm/s, the normal acceleration is 0.866 of that on a radius of 42 mm. All radii here are larger, so the
/// highest speed determines the tangential acceleration.
Part arcs_on(const Machine& machine, bool in_xy) {
    std::string text = "G21 G90 G17\nG64 P0.01\nF3000\nG1 X0 Y0 Z0\n";
    for (int pass = 0; pass < 4; ++pass) {
        for (int k = 1; k <= 12; ++k)
            text += fmt::format("G18 {} X{} Z0 R{}\n", k % 2 == 0 ? "G2" : "G3", pass % 2 == 0 ? 3 * k : 36 - 3 * k,
                                60 + 5 * k);
        for (int k = 1; k <= 6 && in_xy; ++k)
            text += fmt::format("G17 {} X{} Y{} R80\n", k % 2 == 0 ? "G2" : "G3",
                                pass % 2 == 0 ? 36 - 4 * (k % 2) : 4 * (k % 2), 0.5 * pass);
        text += fmt::format("G1 Y{}\n", 0.5 * (pass + 1));
    }
    const Program program = read_text(text + "M30\n");
    return assemble(program, simulate_to_log(program, machine, Vec3::Zero()).log);
}

/// The result of simulations for the highest speeds of all axes; the motion shows 3000 mm/min, and the file has 15,000
/// mm/min.
Identification speeds_from(const Part& part) {
    const RecordedRun run(part);
    RuleScores scores({&run, 1});
    Identification found;
    found.machine = overlapping();
    for (const char* axis : {"x", "y", "z"})
        found.parameters.push_back({"max_speed", axis, 3000, "mm/min", {}, false, "", 3000});
    search_limits(0, scores, found);
    state_limits(limit_intervals(scores, found), found);
    return found;
}

// An arc is limited by the slower axis of its plane. Arcs of the XZ plane do not distinguish X from Z; those of the XY plane
// do.
TEST(SimulatedLimits, SpeedsOfAxesThatOnlyArcsDependOn) {
    Machine real = overlapping();
    set_planning_value(real, "max_speed", "z", 7200);
    const Identification of_both = speeds_from(arcs_on(real, true));
    EXPECT_TRUE(*of_both.find("max_speed", "z")->reached);
    EXPECT_NEAR(of_both.find("max_speed", "z")->value, 7200, 3 * *of_both.find("max_speed", "z")->standard_error);
    EXPECT_DOUBLE_EQ(*planning_value(of_both.machine, "max_speed", "x"), 15'000);
    const Identification of_one = speeds_from(arcs_on(real, false));
    for (const char* axis : {"x", "z"}) {
        EXPECT_FALSE(*of_one.find("max_speed", axis)->reached);
        EXPECT_NEAR(*planning_value(of_one.machine, "max_speed", axis), 7200, 20);
        EXPECT_NEAR(of_one.find("max_speed", axis)->value, 7200, 100);
    }
    EXPECT_DOUBLE_EQ(*planning_value(of_one.machine, "max_speed", "y"), 15'000);
}

// Without arcs only rapids depend on them.
TEST(SimulatedLimits, SpeedsOfAxesAreNotSearchedWithoutArcs) {
    const Identification found = speeds_from(waves_on(overlapping()));
    for (const char* axis : {"x", "y", "z"}) {
        EXPECT_DOUBLE_EQ(*planning_value(found.machine, "max_speed", axis), 15'000);
        EXPECT_DOUBLE_EQ(found.find("max_speed", axis)->value, 3000);
    }
}

// If a path limit has no effect because of the axes, deviations from another fault give it no standard error and no bound
// above the truth.
TEST(SimulatedLimits, WhatAnotherFaultLeavesDeterminesNoLimit) {
    Identification result;
    result.machine.path.max_acceleration = 2511;
    result.parameters = {{"max_acceleration", "path", 650, "mm/s²", {}, false, "", 650}};
    SimulatedLimit limit{"max_acceleration", "path", 2511, 705, 3315, true, false};
    state_limits({limit}, result);
    EXPECT_FALSE(result.parameters[0].standard_error);
    EXPECT_EQ(result.parameters[0].reached, false);
    limit.lowest = 2450, limit.highest = 2600;
    state_limits({limit}, result);
    EXPECT_TRUE(result.parameters[0].standard_error);
}

}  // namespace
}  // namespace clsurf::simulated_limits_test

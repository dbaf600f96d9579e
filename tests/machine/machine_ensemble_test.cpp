// Machines drawn from the uncertainty of a machine file.

#include "machine/machine_ensemble.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "machine/planning_value.h"

namespace clsurf::machine_ensemble_test {
namespace {

TEST(MachineEnsemble, IsTheSameAtEveryCall) {
    const Machine machine;
    const std::vector<Machine> once = machines_drawn_from(machine, 5), again = machines_drawn_from(machine, 7);
    ASSERT_EQ(once.size(), 5U);
    for (std::size_t k = 0; k < once.size(); ++k) {
        EXPECT_EQ(once[k].axes[1].max_acceleration, again[k].axes[1].max_acceleration);
        EXPECT_NE(once[k].axes[1].max_acceleration, machine.axes[1].max_acceleration);
    }
}

// The logarithms of 400 draws have the mean 0 and the stated standard deviation, both within four standard errors.
TEST(MachineEnsemble, DrawsHaveTheStatedError) {
    Machine machine;
    machine.uncertainty = {{.key = "max_jerk", .of = "z", .relative_error = 0.2}};
    const std::vector<Machine> drawn = machines_drawn_from(machine, 400);
    double sum = 0, squares = 0;
    for (const Machine& each : drawn) {
        const double x = std::log(each.axes[2].max_jerk / machine.axes[2].max_jerk);
        sum += x;
        squares += x * x;
        EXPECT_EQ(each.axes[0].max_jerk, machine.axes[0].max_jerk) << "is known";
    }
    EXPECT_NEAR(sum / 400, 0, 4 * 0.2 / 20);
    EXPECT_NEAR(std::sqrt(squares / 400), 0.2, 4 * 0.2 / std::sqrt(800.0));
}

TEST(MachineEnsemble, AValueWithALowerBoundLiesBetweenBoth) {
    Machine machine;
    machine.axes[0].max_acceleration = 3000;
    machine.uncertainty = {{.key = "max_acceleration", .of = "x", .lower_bound = 1000}};
    double least = 1e9, most = 0;
    for (const Machine& each : machines_drawn_from(machine, 100)) {
        least = std::min(least, each.axes[0].max_acceleration);
        most = std::max(most, each.axes[0].max_acceleration);
    }
    EXPECT_GE(least, 1000);
    EXPECT_LE(most, 3000);
    EXPECT_LT(least, 1100);
    EXPECT_GT(most, 2700);
}

TEST(MachineEnsemble, AlternativesComeInTurn) {
    Machine machine;
    machine.uncertainty = {{.key = "lookahead_blocks", .of = "controller", .alternatives = {20, 50, 200}}};
    const std::vector<Machine> drawn = machines_drawn_from(machine, 4);
    EXPECT_EQ(drawn[0].controller.lookahead_blocks, 20);
    EXPECT_EQ(drawn[1].controller.lookahead_blocks, 50);
    EXPECT_EQ(drawn[2].controller.lookahead_blocks, 200);
    EXPECT_EQ(drawn[3].controller.lookahead_blocks, 20);
}

// With more alternatives than machines, the lowest ones alone would not be a fair sample.
TEST(MachineEnsemble, ManyAlternativesAreSpreadOverTheMachines) {
    Machine machine;
    machine.uncertainty = {
        {.key = "lookahead_blocks", .of = "controller", .alternatives = {5, 7, 10, 14, 20, 50, 200, 1000}},
        {.key = "tolerance", .of = "controller", .alternatives = {0.002, 0.005, 0.01, 0.02, 0.05, 0.1}}};
    const std::vector<Machine> drawn = machines_drawn_from(machine, 4);
    const std::array<int, 4> blocks{7, 14, 50, 1000};
    const std::array<double, 4> tolerances{0.01, 0.02, 0.1, 0.002};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(drawn[k].controller.lookahead_blocks, blocks[k]);
        EXPECT_DOUBLE_EQ(drawn[k].controller.tolerance, tolerances[k]);
    }
}

// If a simulation misses speeds by 3 %, accelerations are at least as uncertain.
TEST(MachineEnsemble, FidelityAddsToTheErrorOfAccelerations) {
    Machine machine;
    machine.uncertainty = {{.key = "max_acceleration", .of = "x", .relative_error = 1e-6}};
    const auto spread = [](const Machine& from) {
        double squares = 0;
        for (const Machine& each : machines_drawn_from(from, 400))
            squares += std::pow(std::log(each.axes[0].max_acceleration / from.axes[0].max_acceleration), 2);
        return std::sqrt(squares / 400);
    };
    EXPECT_LT(spread(machine), 2e-6);
    machine.fidelity = Fidelity{};
    machine.fidelity->speed_error_p95_ratio = 0.03;
    EXPECT_NEAR(spread(machine), 0.03, 0.005);
}

TEST(MachineEnsemble, OnlyValuesThatPlanTheMotionAreUncertain) {
    EXPECT_TRUE(is_planning_value("max_normal_acceleration", "path"));
    EXPECT_TRUE(is_planning_value("block_time", "controller"));
    EXPECT_FALSE(is_planning_value("position_gain", "x"));
    EXPECT_FALSE(is_planning_value("max_jerk", "w"));
}

}  // namespace
}  // namespace clsurf::machine_ensemble_test

// Settings of a machine, and the search over them.

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "io/readers/machine_file.h"
#include "repair/parts.h"
#include "tradeoff/settings_search.h"

namespace clsurf::settings_test {
namespace {

double crowded_pass(int pass, double x) { return pass == 3 && x > 3 && x < 5 ? 0.02 : 0.31; }

SettingsTradeoff search(const std::string& text, const Machine& machine, int runs) {
    Program program = read_text(text);
    const MachineOfSettings machine_of = [&](const PlanSettings& settings) { return with_settings(machine, settings); };
    return search_settings(program, machine, machine_of, {}, {0.5, runs, Vec3::Zero()}, {});
}

TEST(PlanSettings, ScaleEveryLimitOfTheirKind) {
    const Machine machine;
    const Machine lower = with_settings(machine, {0.5, 0.8, 0.7, true});
    EXPECT_DOUBLE_EQ(lower.path.max_jerk, 25000);
    EXPECT_DOUBLE_EQ(lower.path.max_acceleration, 1600);
    EXPECT_DOUBLE_EQ(lower.path.max_normal_acceleration, 1200);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_DOUBLE_EQ(lower.axes[k].max_jerk, 40000);
        EXPECT_DOUBLE_EQ(lower.axes[k].max_acceleration, 1600);
        EXPECT_DOUBLE_EQ(lower.axes[k].max_speed, machine.axes[k].max_speed);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_DOUBLE_EQ(lower.rotary[k].max_jerk, 0.5 * machine.rotary[k].max_jerk);
        EXPECT_DOUBLE_EQ(lower.rotary[k].max_acceleration, 0.8 * machine.rotary[k].max_acceleration);
    }
    EXPECT_DOUBLE_EQ(lower.controller.feed_override, 0.7);
    EXPECT_EQ(lower.controller.feed, FeedRule::intervals);
    EXPECT_EQ(lower.controller.tolerance, machine.controller.tolerance);
    EXPECT_EQ(lower.name, "three-axis mill: jerk 50 %, acceleration 80 %, feed 70 %, intervals");
}

TEST(PlanSettings, OfTheMachineFileChangeNothing) {
    Machine machine;
    machine.fidelity.emplace();
    EXPECT_TRUE(with_settings(machine, {}).fidelity.has_value());
    EXPECT_EQ(with_settings(machine, {}).name, machine.name);
    // The fidelity was measured with other settings.
    EXPECT_FALSE(with_settings(machine, {0.5}).fidelity.has_value());
}

TEST(PlanSettings, SurviveTheirMachineFile) {
    const Machine machine;
    const std::string text = io::machine_text(with_settings(machine, {0.7, 0.42, 0.85, true}));
    EXPECT_EQ(io::machine_text(io::machine_of_text(text, "settings")), text);
}

TEST(PlanSettings, KnowWhetherThereIsAJerkLimit) {
    Machine machine;
    EXPECT_TRUE(limits_jerk(machine));
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    EXPECT_TRUE(limits_jerk(machine));  // the jerk limit of the path
    machine.path.max_jerk = 2 * machine.path.max_acceleration / machine.controller.period;
    EXPECT_FALSE(limits_jerk(machine));
    machine.path.max_jerk = 50000;
    machine.controller.planner = PlannerKind::trapezoidal;
    EXPECT_FALSE(limits_jerk(machine));
}

TEST(SettingsSearch, KeepsItsBounds) {
    const SettingsTradeoff found = search(wavy_zigzag(6, 8, crowded_pass), Machine{}, 14);
    const std::vector<TradeoffRow>& rows = found.front.rows;
    ASSERT_EQ(rows.size(), found.settings.size());
    EXPECT_LE(rows.size(), 14U);
    EXPECT_GE(rows.size(), 8U);
    EXPECT_EQ(found.settings.front(), PlanSettings{});
    for (std::size_t k = 1; k < rows.size(); ++k) {
        EXPECT_LE(rows[k].quality.duration, 1.5 * rows[0].quality.duration);
        if (k > 1) { EXPECT_GE(rows[k].quality.duration, rows[k - 1].quality.duration); }
        EXPECT_NE(found.settings[k], PlanSettings{});
        for (std::size_t j = 0; j < k; ++j) EXPECT_NE(found.settings[j], found.settings[k]) << "tried twice";
    }
}

TEST(SettingsSearch, DoesNotDependOnThreads) {
    const std::string text = wavy_zigzag(5, 6, crowded_pass);
    set_thread_count(1);
    const SettingsTradeoff alone = search(text, Machine{}, 12);
    set_thread_count(2);
    const SettingsTradeoff both = search(text, Machine{}, 12);
    set_thread_count(0);
    ASSERT_EQ(alone.settings, both.settings);
    for (std::size_t k = 0; k < alone.settings.size(); ++k) {
        EXPECT_EQ(alone.front.rows[k].quality.duration, both.front.rows[k].quality.duration);
        EXPECT_EQ(alone.front.rows[k].quality.mismatch, both.front.rows[k].quality.mismatch);
        EXPECT_EQ(alone.front.rows[k].quality.jerk, both.front.rows[k].quality.jerk);
    }
}

// One pass has no neighbours.
TEST(SettingsSearch, RefusesAPartWithoutAdjacentPasses) {
    EXPECT_THROW((void)search("G21 G90\nG0 X0 Y0 Z5\nG1 Z0 F1000\nX50 F3000\nG0 Z5\nM2\n", Machine{}, 8), InputError);
}

}  // namespace
}  // namespace clsurf::settings_test

// The cure: speeds about the defects of a run, what they cost, and what they gained.

#include "optimize/cure.h"

#include <gtest/gtest.h>

#include <numeric>

#include "optimize/levelling.h"
#include "optimize/parts.h"
#include "surface/station.h"

namespace clsurf {
namespace {

/// Flat passes, the fourth of which has 100 points in 2 mm: blocks of 0.02 mm in 2 ms are passed at 10 mm/s instead of 50.
struct SlowStretch {
    Program program;
    JudgedRun run;

    explicit SlowStretch(double crowded = 0.02)
        : program(read_text(wavy_zigzag(
              9, 24, [=](int pass, double x) { return pass == 3 && x > 10 && x < 12 ? crowded : 0.31; }, 0))) {
        Machine machine;
        machine.path.max_jerk = 1e6;
        for (MachineAxis& axis : machine.axes) axis.max_jerk = 2e6;
        machine.controller.block_time = 0.002;
        Diagnostics diagnostics;
        run = judge_run(simulate_to_log(program, machine, Vec3::Zero(), {}).log, program, {}, diagnostics);
    }
};

double lost(const JudgedRun& run, const std::vector<float>& speeds) {
    const std::vector<float> own = compared_speeds(run);
    double sum = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (speeds[i] < own[i]) sum += run.log.period * (own[i] / speeds[i] - 1);
    }
    return sum;
}

// The passes beside the slow stretch go at most a step faster, those next to them two steps, and so on: a larger budget buys a smaller step.
TEST(Levelling, TakesTheLeastStepThatABudgetPaysFor) {
    const SlowStretch part;
    double before = 0;
    for (const double wanted : {30.0, 12.0, 5.0}) {
        const double budget = lost(part.run, levelled_speeds(part.run, {0, wanted}));
        EXPECT_GT(budget, before) << wanted;
        before = budget;
        const double step = affordable_step(part.run, {}, budget);
        EXPECT_NEAR(step, wanted, 0.1) << "one part in 1024 of twice the greatest difference";
        EXPECT_LE(lost(part.run, levelled_speeds(part.run, {0, step})), budget);
    }
}

TEST(Cure, LevelsThePassesBesideASlowStretch) {
    const SlowStretch part;
    ASSERT_FALSE(part.run.report.defects.empty());
    const CuringSpeeds cure = curing_speeds(part.run, {.step = 0.25, .budget = 1e9, .lag_power = 3, .hopeless = {}});
    const std::vector<float> own = compared_speeds(part.run);
    std::size_t lowered = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (!(own[i] == own[i])) continue;
        ASSERT_LE(cure.speeds[i], own[i]);
        lowered += cure.speeds[i] < 0.9F * own[i] ? 1 : 0;
        if (cure.causes[i] < 0) {
            EXPECT_EQ(cure.speeds[i], own[i]);
            continue;
        }
        const auto point = static_cast<PointIndex>(i);
        for (const Side side : {Side::left, Side::right}) {
            const Station at = beside(part.run.surface, {point, 0}, part.run.signals.feed(point), side);
            if (!at.exists()) continue;
            const auto j = static_cast<std::size_t>(at.point);
            const float other =
                at.fraction > 0 ? cure.speeds[j] + at.fraction * (cure.speeds[j + 1] - cure.speeds[j]) : cure.speeds[j];
            if (!(other == other)) continue;
            EXPECT_LE(cure.speeds[i], 1.251F * other) << i;
        }
    }
    // 2 mm at 50 mm/s are 40 points; a fifth of the speed is seven steps of a quarter away: more than that on both sides.
    EXPECT_GT(lowered, 80U);
}

TEST(Cure, KeepsItsBudget) {
    const SlowStretch part;
    const double whole =
        lost(part.run, curing_speeds(part.run, {.step = 0.1, .budget = 1e9, .lag_power = 3, .hopeless = {}}).speeds);
    EXPECT_GT(whole, 0.1);
    for (const double share : {0.0, 0.3, 0.7})
        EXPECT_LE(
            lost(
                part.run,
                curing_speeds(part.run, {.step = 0.1, .budget = share * whole, .lag_power = 3, .hopeless = {}}).speeds),
            share * whole);
}

TEST(Cure, LetsHopelessPlacesBe) {
    const SlowStretch part;
    CureRules rules{.step = 0.1, .budget = 1e9, .lag_power = 3, .hopeless = {}};
    for (const Defect& defect : part.run.report.defects) rules.hopeless.push_back(defect.position);
    EXPECT_EQ(lost(part.run, curing_speeds(part.run, rules).speeds), 0);
}

TEST(Cure, CountsWhatItGained) {
    const SlowStretch slow, even(0.31);
    const CuringSpeeds cure = curing_speeds(slow.run, {.step = 0.1, .budget = 1e9, .lag_power = 3, .hopeless = {}});
    const auto sum = [](const std::vector<int>& gains) { return std::accumulate(gains.begin(), gains.end(), 0); };
    EXPECT_EQ(sum(gains_of(cure, slow.run, slow.run)), 0);
    EXPECT_GT(sum(gains_of(cure, slow.run, even.run)), 0);
}

TEST(Cure, KnowsHowLagGrowsWithSpeed) {
    Machine machine;
    EXPECT_EQ(lag_power(machine), 3);
    machine.axes[2].servo.position_gain = 60;
    EXPECT_EQ(lag_power(machine), 1);
}

TEST(Levelling, FeedsAreThoseOfIntervals) {
    // 100.4 lies within 0.5 % of 100, 104 does not; the last motion may not be slowed.
    EXPECT_EQ(levelling_feeds({0, 100.4F, 100, 104, 0, 50}, {1, 1, 1, 1, 1, 0}, 0.005),
              (std::vector<float>{0, 100, 100, 104, 0, 0}));
}

TEST(JudgedRun, IsJudgedByTheThresholdsOfAnother) {
    const SlowStretch slow;
    QualityRules rules;
    rules.fixed = slow.run.report.thresholds;
    for (float& threshold : rules.fixed->of) threshold *= 100;
    const QualityReport report =
        find_defects(slow.run.surface, slow.run.signals, *slow.run.lines, slow.program, slow.run.log.period, rules);
    EXPECT_EQ(report.thresholds.of, rules.fixed->of);
    EXPECT_TRUE(report.defects.empty());
    rules.fixed = slow.run.report.thresholds;
    EXPECT_EQ(
        find_defects(slow.run.surface, slow.run.signals, *slow.run.lines, slow.program, slow.run.log.period, rules)
            .defects.size(),
        slow.run.report.defects.size());
}

}  // namespace
}  // namespace clsurf

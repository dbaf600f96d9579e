// The feed reduction: speeds around the defects of a run, their cost, and their gain.

#include "repair/feeds/feed_reduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "repair/feeds/feed_equalisation.h"
#include "repair/parts.h"
#include "surface/path_location.h"
#include "toolpath/toolpath.h"

namespace clsurf::feed_reduction_test {
namespace {

/// Flat passes, the fourth of which has 100 points in 2 mm: blocks of 0.02 mm in 2 ms are run at 10 mm/s instead of 50.
/// With another section the sixth has points 0.08 mm apart in 2 mm, which are run at 40 mm/s.
struct SlowSection {
    Program program;
    JudgedRun run;

    explicit SlowSection(double crowded = 0.02, bool another = false)
        : program(read_text(wavy_zigzag(
              9, 24,
              [=](int pass, double x) {
                  if (another && pass == 5 && x > 16 && x < 18) return 0.08;
                  return pass == 3 && x > 6 && x < 8 ? crowded : 0.31;
              },
              0))) {
        Machine machine;
        machine.path.max_jerk = 1e6;
        for (MachineAxis& axis : machine.axes) axis.max_jerk = 2e6;
        machine.controller.block_time = 0.002;
        Diagnostics diagnostics;
        run = judge_run(simulate_to_log(program, machine, Vec3::Zero(), {}).log, program, diagnostics);
    }
};

// The passes next to the slow section are at most one step faster, the next ones two steps, and so on: a larger budget allows
// a smaller step.
TEST(FeedEqualisation, TakesTheLeastStepThatABudgetPaysFor) {
    const SlowSection part;
    const FeedEqualiser equaliser(part.run);
    double before = 0;
    for (const double wanted : {30.0, 12.0, 5.0}) {
        const double budget = equaliser.lost(equaliser.everywhere({0, wanted}));
        EXPECT_GT(budget, before) << wanted;
        before = budget;
        const double step = equaliser.affordable_step({}, budget);
        EXPECT_NEAR(step, wanted, 0.1) << "one part in 1024 of twice the greatest difference";
        EXPECT_LE(equaliser.lost(equaliser.everywhere({0, step})), budget);
    }
}

// Of lines of 0.02 mm at 50 mm/s a record names every second or third one. The others get the speed of adjacent lines.
TEST(FeedEqualisation, LinesThatNoRecordNamesHaveASpeed) {
    const Program program = read_text(wavy_zigzag(
        3, 24, [](int, double) { return 0.02; }, 0));
    Machine machine;
    machine.controller.block_time = 0;
    Diagnostics diagnostics;
    const JudgedRun run = judge_run(simulate_to_log(program, machine, Vec3::Zero(), {}).log, program, diagnostics);
    const std::vector<float> peaks = peaks_by_motion(run, program, compared_speeds(run));
    std::set<LineNumber> named;
    for (PointIndex i = 0; i < run.surface.positions.size(); ++i) named.insert(run.lines->line_at(i));
    const Toolpath path(program.motions, Vec3::Zero());
    std::size_t without = 0, unnamed = 0, middle = 0;
    for (std::int64_t m = 0; m < program.motions.size(); ++m) {
        const auto k = static_cast<std::size_t>(m);
        const double x = path.end(static_cast<std::uint32_t>(m)).x();
        if (program.motions.kind[k] != MotionKind::feed || x < 4 || x > 20) continue;
        ++middle;
        unnamed += named.contains(program.motions.line[k]) ? 0 : 1;
        without += peaks[k] > 0 ? 0 : 1;
    }
    EXPECT_GT(unnamed, middle / 4) << "else this tests nothing";
    EXPECT_EQ(without, 0U);
}

TEST(FeedReductionTest, LevelsThePassesBesideASlowSection) {
    const SlowSection part;
    ASSERT_FALSE(part.run.report.defects.empty());
    const ReducedSpeeds reduction =
        reduced_speeds(part.run, {.step = 0.25, .budget = 1e9, .lag_power = 3, .abandoned = {}});
    const std::vector<float> own = compared_speeds(part.run);
    std::size_t lowered = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (!(own[i] == own[i])) continue;
        ASSERT_LE(reduction.speeds[i], own[i]);
        lowered += reduction.speeds[i] < 0.9F * own[i] ? 1 : 0;
        if (reduction.causes[i] < 0) {
            EXPECT_EQ(reduction.speeds[i], own[i]);
            continue;
        }
        const auto point = static_cast<PointIndex>(i);
        for (const Side side : {Side::left, Side::right}) {
            const PathLocation at = adjacent_location(part.run.surface, {point, 0}, part.run.signals.feed(point), side);
            if (!at.exists()) continue;
            const auto j = static_cast<std::size_t>(at.point);
            const float other =
                at.fraction > 0 ? reduction.speeds[j] + at.fraction * (reduction.speeds[j + 1] - reduction.speeds[j])
                                : reduction.speeds[j];
            if (!(other == other)) continue;
            EXPECT_LE(reduction.speeds[i], 1.251F * other) << i;
        }
    }
    // 2 mm at 50 mm/s are 40 points; a fifth of the speed is seven steps of a quarter away: more than that on both sides.
    EXPECT_GT(lowered, 80U);
}

TEST(FeedReductionTest, KeepsItsBudget) {
    const SlowSection part;
    const FeedEqualiser equaliser(part.run);
    const auto lost = [&](double budget) {
        return equaliser.lost(
            reduced_speeds(part.run, {.step = 0.1, .budget = budget, .lag_power = 3, .abandoned = {}}).speeds);
    };
    const double whole = lost(1e9);
    EXPECT_GT(whole, 0.1);
    for (const double share : {0.0, 0.3, 0.7}) EXPECT_LE(lost(share * whole), share * whole);
}

// The mild one is affordable, although both together, or the severe one alone, cost more.
TEST(FeedReductionTest, TakesTheCheapestDefectsFirst) {
    const SlowSection part(0.02, true);
    const FeedEqualiser equaliser(part.run);
    const auto lost_where = [&](double budget, double first, double last) {
        std::vector<float> speeds =
            reduced_speeds(part.run, {.step = 0.1, .budget = budget, .lag_power = 3, .abandoned = {}}).speeds;
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const double x = part.run.surface.positions.absolute(static_cast<PointIndex>(i)).x();
            if (x < first || x > last) speeds[i] = equaliser.own()[i];
        }
        return equaliser.lost(speeds);
    };
    const double severe = lost_where(1e9, 12, 24), mild = lost_where(1e9, 0, 12);
    ASSERT_GT(mild, 0);
    ASSERT_GT(severe, 2 * mild);
    EXPECT_EQ(lost_where(0.9 * severe, 12, 24), 0);
    EXPECT_NEAR(lost_where(0.9 * severe, 0, 12), mild, 1e-9);
    EXPECT_EQ(lost_where(0.9 * mild, 0, 24), 0);
}

// A pass next to the slow section is lowered by a tenth there: the adjacent ones follow, but need not reach the slow speed.
TEST(FeedEqualisation, LeavesOtherSlowPlacesBesideALoweredOne) {
    const SlowSection part;
    const FeedEqualiser equaliser(part.run);
    const std::size_t n = equaliser.own().size();
    const auto lost = [&](std::uint8_t equalised) {
        FeedEqualisation equalisation{equaliser.own(), std::vector<std::int32_t>(n, -1),
                                      std::vector<std::uint8_t>(n, 0)};
        for (PointIndex i = 0; i < part.run.surface.positions.size(); ++i) {
            const Vec3 p = part.run.surface.positions.absolute(i);
            const auto k = static_cast<std::size_t>(i);
            if (std::abs(p.y() - 1.6) > 0.1 || std::abs(p.x() - 17) > 1) continue;  // the fifth pass
            equalisation.speeds[k] *= 0.9F;
            equalisation.causes[k] = 0;
            equalisation.equalised[k] = equalised;
        }
        equaliser.equalise({.share = 0.1}, equalisation);
        return equaliser.lost(equalisation.speeds);
    };
    // 2 mm at 45 instead of 50 mm/s
    EXPECT_NEAR(lost(0), 2.0 / 45 - 2.0 / 50, 0.002);
    EXPECT_GT(lost(1), 10 * lost(0));
}

TEST(FeedReductionTest, LetsHopelessPlacesBe) {
    const SlowSection part;
    FeedReductionRules rules{.step = 0.1, .budget = 1e9, .lag_power = 3, .abandoned = {}};
    for (const Defect& defect : part.run.report.defects) rules.abandoned.push_back(defect.place.tip);
    EXPECT_EQ(FeedEqualiser(part.run).lost(reduced_speeds(part.run, rules).speeds), 0);
}

TEST(FeedReductionTest, CountsWhatItGained) {
    const SlowSection slow, even(0.31);
    const ReducedSpeeds reduction =
        reduced_speeds(slow.run, {.step = 0.1, .budget = 1e9, .lag_power = 3, .abandoned = {}});
    const auto sum = [](const std::vector<int>& gains) { return std::accumulate(gains.begin(), gains.end(), 0); };
    EXPECT_EQ(sum(gains_of(reduction, slow.run, slow.run)), 0);
    EXPECT_GT(sum(gains_of(reduction, slow.run, even.run)), 0);
}

TEST(FeedReductionTest, KnowsHowLagGrowsWithSpeed) {
    Machine machine;
    EXPECT_EQ(lag_power(machine), 3);
    machine.axes[2].servo.position_gain = 60;
    EXPECT_EQ(lag_power(machine), 1);
}

TEST(FeedEqualisation, FeedsAreThoseOfIntervals) {
    // 100.4 is within 0.5 % of 100, 104 is not; the last motion must not be slowed.
    EXPECT_EQ(equalised_feeds({0, 100.4F, 100, 104, 0, 50}, {1, 1, 1, 1, 1, 0}, 0.005),
              (std::vector<float>{0, 100, 100, 104, 0, 0}));
}

TEST(FeedEqualisation, MergedMotionsShareTheHighestTarget) {
    EXPECT_EQ(block_targets({0, 40, 30, 20, 10, 0}, {0, 1, 1, 0, 1, 0}), (std::vector<float>{0, 40, 40, 40, 10, 10}));
    EXPECT_EQ(block_targets({}, {}), std::vector<float>{});
}

TEST(JudgedRun, IsJudgedByTheThresholdsOfAnother) {
    const SlowSection slow;
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
}  // namespace clsurf::feed_reduction_test

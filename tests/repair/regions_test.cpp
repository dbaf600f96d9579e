// Mixing by region: where a changed program runs worse, and that restoring the original there makes it better.

#include "repair/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "repair/optimizer.h"
#include "repair/parts.h"
#include "repair/repair_mask.h"

namespace clsurf::regions_test {
namespace {

/// Flat passes, the fifth of which (it runs forward) has 100 points between `from` and `from` + 2 mm.
Program crowded_at(double from) {
    return read_text(wavy_zigzag(
        9, 40, [=](int pass, double x) { return pass == 4 && x > from && x < from + 2 ? 0.02 : 0.31; }, 0));
}

JudgedRun run_of(const Program& program) {
    Diagnostics diagnostics;
    return judge_run(simulate_to_log(program, slow_at_short_blocks(), Vec3::Zero(), {}).log, program, diagnostics);
}

/// Per motion of the program: 1 if another run of it is worse there than the first.
std::vector<std::uint8_t> worse_motions(const JudgedRun& before, const JudgedRun& after, const Program& program) {
    const std::array<const JudgedRun*, 2> runs{&before, &after};
    std::vector<std::uint8_t> worse = best_runs(runs, 1, program, {});
    for (std::uint8_t& motion : worse) motion = motion == 0 ? 1 : 0;
    return worse;
}

/// The value of the cutting motion that ends near a place; −1: no motion ends there.
int value_near(const Program& program, const std::vector<std::uint8_t>& of_motion, double x, double y) {
    for (std::size_t i = 0; i < of_motion.size(); ++i) {
        const Vec3 end = program.motions.end[i].vec();
        if (std::abs(end.x() - x) < 0.4 && std::abs(end.y() - y) < 0.01 && end.z() < 5) return of_motion[i];
    }
    return -1;
}

bool marked_near(const Program& program, const std::vector<std::uint8_t>& marks, double x, double y) {
    return value_near(program, marks, x, y) > 0;
}

// The slow place moves from x = 11 to x = 29: the run is worse around the second, on the adjacent passes as well.
TEST(Regions, AreWhereTheOtherRunIsWorse) {
    const Program program = crowded_at(10), changed = crowded_at(28);
    const JudgedRun before = run_of(program), after = run_of(changed);
    const std::vector<std::uint8_t> worse = worse_motions(before, after, program);
    ASSERT_EQ(worse.size(), static_cast<std::size_t>(program.motions.size()));
    const double y = 4 * 0.4;
    EXPECT_TRUE(marked_near(program, worse, 29, y));
    EXPECT_TRUE(marked_near(program, worse, 29, y - 0.4) && marked_near(program, worse, 29, y + 0.4))
        << "the passes beside it";
    EXPECT_FALSE(marked_near(program, worse, 11, y) || marked_near(program, worse, 11, y + 0.4)) << "is better";
    EXPECT_FALSE(marked_near(program, worse, 20, y) || marked_near(program, worse, 3, y)) << "is the same";
}

TEST(Regions, AreNoneBetweenARunAndItself) {
    const Program program = crowded_at(10);
    const JudgedRun run = run_of(program);
    const std::vector<std::uint8_t> worse = worse_motions(run, run, program);
    EXPECT_EQ(std::count(worse.begin(), worse.end(), 1), 0);
}

// Equally slower on all passes: no defect, no difference between them, but time.
TEST(Regions, ThatCostTimeAreGivenBack) {
    const auto of = [](double spacing) {
        return read_text(wavy_zigzag(
            9, 40, [=](int, double x) { return x > 18 && x < 22 ? spacing : 0.31; }, 0));
    };
    const Program program = of(0.31), changed = of(0.02);
    const JudgedRun before = run_of(program), after = run_of(changed);
    ASSERT_GT(after.duration, before.duration + 9 * 0.2);  // 4 mm at 10 mm/s instead of 50
    const std::vector<std::uint8_t> worse = worse_motions(before, after, program);
    for (int pass = 0; pass < 9; ++pass) EXPECT_TRUE(marked_near(program, worse, 20, 0.4 * pass)) << pass;
    const std::vector<std::uint8_t> reverse = worse_motions(after, before, changed);
    EXPECT_EQ(std::count(reverse.begin(), reverse.end(), 1), 0) << "what saves time is kept";
}

// One run is bad on the left, the other one on the right: the combination has the good half of each.
TEST(Regions, TakeTheBestOfSeveralRuns) {
    const Program left = crowded_at(8), right = crowded_at(30);
    const Program program = read_text(wavy_zigzag(
        9, 40, [](int pass, double x) { return pass == 4 && x > 8 && x < 32 ? 0.02 : 0.31; }, 0));
    const JudgedRun before = run_of(program), bad_left = run_of(left), bad_right = run_of(right);
    const std::array<const JudgedRun*, 3> runs{&before, &bad_left, &bad_right};
    const std::vector<std::uint8_t> best = best_runs(runs, 0, program, {});
    const auto best_at = [&](double x) { return value_near(program, best, x, 4 * 0.4); };
    EXPECT_EQ(best_at(9), 2);
    EXPECT_EQ(best_at(31), 1);
    EXPECT_EQ(best_at(3), 0) << "is the same in all";
}

// A slow section of one pass, and the same part slow everywhere: this removes the difference, but takes time.
TEST(Regions, TakeNoMoreTimeThanThereIs) {
    const Program program = read_text(wavy_zigzag(
        9, 40, [](int pass, double x) { return pass == 4 && x > 10 && x < 14 ? 0.07 : 0.31; }, 0));
    const Program even = read_text(wavy_zigzag(
        9, 40, [](int, double) { return 0.05; }, 0));
    const JudgedRun before = run_of(program), slow = run_of(even);
    ASSERT_GT(slow.duration, before.duration + 1);
    const std::array<const JudgedRun*, 2> runs{&before, &slow};
    const double y = 4 * 0.4;
    RegionRules rules;
    EXPECT_FALSE(marked_near(program, best_runs(runs, 0, program, rules), 12, y));
    rules.more_time = (slow.duration - before.duration) / before.log.period;
    const std::vector<std::uint8_t> best = best_runs(runs, 0, program, rules);
    EXPECT_TRUE(marked_near(program, best, 12, y));
    EXPECT_FALSE(marked_near(program, best, 30, y)) << "is as even in the first run";
}

/// A part with crowded points to be repaired, and with bends where the points of every pass are at different places.
Program mixed_part() {
    return read_text(wavy_zigzag(6, 9, [](int pass, double x) {
        return pass == 3 && x > 3 && x < 4 ? 0.02 : 0.23 + 0.1 * std::abs(std::sin(1.7 * pass + 0.6 * x));
    }));
}

TEST(Draft, KeepsWhatIsGivenBackByteForByte) {
    const Program program = mixed_part();
    std::vector<std::uint8_t> needed(static_cast<std::size_t>(program.motions.size()), 1);
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (program.motions.end[i].x <= 5) continue;
        needed[i] = 0;
        kept.emplace_back(program.main().line(program.motions.line[i]));
    }
    const ReadProgram read = read_text;
    const Machine machine;
    OptimizeRules rules;
    const Draft draft = Drafter(program, read, machine, rules, true).draft({0.001, 0}, needed);
    ASSERT_GT(draft.segments, 0U);
    std::istringstream now(draft.text);
    std::size_t next = 0;
    for (std::string line; std::getline(now, line) && next < kept.size();) next += line == kept[next] ? 1 : 0;
    EXPECT_EQ(next, kept.size()) << kept[std::min(next, kept.size() - 1)];
}

TEST(Optimizer, IsNeverWorseThanADraftTakenWhole) {
    const Program program = mixed_part();
    const Machine machine = slow_at_short_blocks();
    const ReadProgram read = read_text;
    const OptimizeRules rules;
    const Progress silent;
    Diagnostics diagnostics;
    Optimized result = optimize(program, read, machine, rules, {}, silent, diagnostics);
    Proposal taken;
    taken.evaluation = result.evaluation;
    taken.run = std::move(result.after);
    Evaluator evaluator(program, read, machine, rules, silent, diagnostics);
    const Drafter drafter(program, read, machine, rules, true);
    const double shortest_line = 1.1 * machine.controller.block_time * 50;
    for (const double share : {0.1, 0.2, 0.4}) {
        const TriedProposal whole = evaluator.propose(
            std::make_shared<const Draft>(
                drafter.draft({share * rules.tolerance, shortest_line}, repair_mask(evaluator.before(), program, {}))),
            {});
        EXPECT_FALSE(evaluator.better(*whole, taken)) << share;
    }
}

}  // namespace
}  // namespace clsurf::regions_test

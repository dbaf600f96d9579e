// The repair as a whole: what it changes and keeps, how far it deviates from the path, and that it
// refuses results that are not better.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>

#include "core/error.h"
#include "numeric/polyline.h"
#include "repair/line_edit.h"
#include "repair/optimizer.h"
#include "repair/parts.h"
#include "repair/points/resample.h"
#include "repair/repair_mask.h"

namespace clsurf::optimizer_test {
namespace {

std::vector<Vec3> corners_of(const Program& program) {
    std::vector<Vec3> corners;
    for (const Xyz& end : program.motions.end) corners.push_back(end.vec());
    return corners;
}

/// The largest distance of points every 0.02 mm of one polyline to the other one: brute force.
double farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    double most = 0;
    for (std::size_t i = 1; i < from.size(); ++i) {
        const int pieces = std::max(1, static_cast<int>((from[i] - from[i - 1]).norm() / 0.02));
        for (int k = 1; k <= pieces; ++k) {
            const Vec3 p = from[i - 1] + (from[i] - from[i - 1]) * k / pieces;
            double nearest = 1e9;
            for (std::size_t j = 1; j < to.size(); ++j)
                nearest = std::min(nearest, (p - nearest_on_line(p, to[j - 1], to[j])).norm());
            most = std::max(most, nearest);
        }
    }
    return most;
}

std::string resampled_text(const Program& program, double tolerance, double spacing) {
    LineEditor editor(program);
    for (const ResampledSegment& section : resample(program, build_programmed_surface(program), editor,
                                                    {tolerance, spacing, 0.2 * tolerance, 0, 0.5}, {}))
        editor.replace(section.first, section.last, section.points);
    return editor.text("");
}

/// A machine with so much jerk that only acceleration counts: fast to plan.
Machine brisk() {
    Machine machine;
    machine.path.max_jerk = 1e6;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 2e6;
    return machine;
}

double crowded(int pass, double x) { return pass == 2 && x > 3 && x < 5 ? 0.02 : 0.31; }

TEST(Resample, StaysInsideTheToleranceEverywhere) {
    const Program program = read_text(wavy_zigzag(5, 8, crowded));
    for (const double tolerance : {0.001, 0.003, 0.01}) {
        for (const double spacing : {0.1, 0.25, 0.6}) {
            const Program changed = read_text(resampled_text(program, tolerance, spacing));
            const double forth = farthest(corners_of(changed), corners_of(program)),
                         back = farthest(corners_of(program), corners_of(changed));
            EXPECT_LE(std::max(forth, back), tolerance) << tolerance << " " << spacing;
            const Deviation measured = measure_deviation(program, changed, 0.02);
            EXPECT_EQ(measured.disordered, 0U);
            EXPECT_NEAR(measured.greatest, std::max(forth, back), 2e-6);
        }
    }
}

TEST(Resample, PutsPointsSideBySide) {
    const Program program = read_text(wavy_zigzag(5, 8, crowded));
    const Program changed = read_text(resampled_text(program, 0.01, 0.25));
    // Inner points are next to those of the previous pass, except at the ends of passes.
    std::set<int> of_pass[5];
    for (const Xyz& p : changed.motions.end) {
        const int pass = static_cast<int>(std::lround(p.y / 0.4));
        if (p.x > 1 && p.x < 7 && p.z < 5) of_pass[pass].insert(static_cast<int>(std::lround(p.x * 50)));
    }
    for (int pass = 1; pass < 5; ++pass) {
        std::size_t shared = 0;
        const std::set<int>& before = of_pass[pass - 1];
        for (const int x : of_pass[pass]) shared += before.lower_bound(x - 2) != before.upper_bound(x + 2) ? 1 : 0;
        EXPECT_GE(shared, of_pass[pass].size() * 8 / 10) << "pass " << pass;
        EXPECT_GT(of_pass[pass].size(), 15U);
    }
}

// A valley of 60° that the program rounds by lines of 0.02 mm, none of which turns by more than 16°: smoothed on both sides,
// never in it.
TEST(Resample, LeavesCreasesAlone) {
    std::string text = "G21 G90\nG64 P0.005\nG0 X0 Y0 Z10\nG1 Z3 F1000\nG1 F3000\n";
    std::vector<std::string> crease;
    for (int pass = 0; pass < 5; ++pass) {
        const double y = 0.4 * pass, slope = std::tan(30 * std::numbers::pi / 180);
        const bool back = pass % 2 == 1;
        std::vector<double> arc_lengths;
        for (double x = 0; x < 4.9; x += 0.31) arc_lengths.push_back(x);
        for (const double x : {4.96, 4.98, 5.0, 5.02, 5.04}) arc_lengths.push_back(x);
        for (double x = 5.2; x < 10.1; x += 0.31) arc_lengths.push_back(x);
        if (back) std::reverse(arc_lengths.begin(), arc_lengths.end());
        for (const double x : arc_lengths) {
            const double off = std::abs(x - 5), z = slope * (off < 0.05 ? off * off / 0.1 + 0.025 : off);
            const std::string line = fmt::format("X{:.4f} Y{:.4f} Z{:.4f}", x, y, z);
            if (off < 0.03) crease.push_back(line);
            text += line + "\n";
        }
    }
    const Program program = read_text(text + "G0 Z10\nM2\n");
    const std::string changed = resampled_text(program, 0.005, 0.25);
    ASSERT_NE(changed, text);
    for (const std::string& line : crease) EXPECT_NE(changed.find(line + "\n"), std::string::npos) << line;
}

// Gentle waves: no line must be shorter for the tolerance. A line may be shorter where it meets a point that is kept.
TEST(Resample, LaysNoLineShorterThanItMay) {
    const Program program = read_text(wavy_zigzag(
        7, 12, [](int pass, double x) { return 0.25 + 0.05 * std::sin(pass + x); }, 0.2));
    LineEditor editor(program);
    const double shortest = 0.2;
    for (const ResampledSegment& section :
         resample(program, build_programmed_surface(program), editor, {0.01, 0.09, 0.004, shortest, 0.5}, {})) {
        for (std::size_t k = 1; k < section.points.size(); ++k)
            EXPECT_GE((section.points[k] - section.points[k - 1]).norm(), 0.99 * shortest);
    }
}

// Flat passes; the fourth one has 100 points where the others have six.
TEST(Need, IsWhereARunDiffersAndBesideIt) {
    const Program program = read_text(wavy_zigzag(
        7, 30, [](int pass, double x) { return pass == 3 && x > 10 && x < 12 ? 0.02 : 0.31; }, 0));
    Machine machine = brisk();
    machine.controller.block_time = 0.002;
    Diagnostics diagnostics;
    const JudgedRun run = judge_run(simulate_to_log(program, machine, Vec3::Zero(), {}).log, program, diagnostics);
    const std::vector<std::uint8_t> needed = repair_mask(run, program, {});
    ASSERT_EQ(needed.size(), static_cast<std::size_t>(program.motions.size()));
    const auto needed_near = [&](double x, double y) {
        for (std::size_t i = 0; i < needed.size(); ++i) {
            const Vec3 end = program.motions.end[i].vec();
            if (std::abs(end.x() - x) < 0.2 && std::abs(end.y() - y) < 0.01 && end.z() < 5) return needed[i] != 0;
        }
        return false;
    };
    const double slow = 30 - 11;  // the fourth pass runs back
    EXPECT_TRUE(needed_near(slow, 1.2));
    EXPECT_TRUE(needed_near(slow, 0.8) && needed_near(slow, 1.6)) << "the passes beside it";
    EXPECT_TRUE(needed_near(slow, 0.4)) << "the next but one";
    EXPECT_FALSE(needed_near(8, 1.2) || needed_near(8, 0));
}

TEST(Deviation, IsThatOfAPlantedBump) {
    const Program straight = read_text("G0 X0 Y0 Z0\nG1 X10 F600\nX20\nX30\n");
    const Program bumped = read_text("G0 X0 Y0 Z0\nG1 X10 F600\nX15 Y0.02\nX20 Y0\nX30\n");
    const Deviation deviation = measure_deviation(straight, bumped);
    EXPECT_NEAR(deviation.greatest, 0.02, 1e-9);
    EXPECT_EQ(deviation.line.line, 3U);
    EXPECT_EQ(measure_deviation(straight, straight).greatest, 0);
}

// A pass that is left out counts as a deviation of at least a step-over, far above any tolerance.
TEST(Deviation, SeesAPassThatIsLeftOut) {
    const Program whole = read_text("G0 X0 Y0 Z0\nG1 X20 F600\nY0.4\nX0\nY0.8\nX20\n");
    const Program cut = read_text("G0 X0 Y0 Z0\nG1 X20 F600\nY0.8\nX20\n");
    const Deviation deviation = measure_deviation(whole, cut);
    EXPECT_GT(deviation.greatest, 0.39);
    EXPECT_EQ(deviation.line.line, 5U);
    EXPECT_TRUE(deviation.line.of_first) << "the second program has no line there";
}

TEST(Deviation, SeesRapidsArcsAndDwellsThatChanged) {
    const Program before = read_text("G0 X0 Y0 Z0\nG1 X10 F600\nG4 P1\nX20\nG0 Z5\n");
    EXPECT_EQ(measure_deviation(before, read_text("G0 X0 Y0 Z0\nG1 X10 F600\nG4 P2\nX20\nG0 Z5\n")).disordered, 3U);
    EXPECT_EQ(measure_deviation(before, read_text("G0 X0 Y0 Z0\nG1 X10 F600\nG4 P1\nX20\nG0 Z6\n")).disordered, 5U);
    EXPECT_EQ(measure_deviation(before, before).disordered, 0U);
}

// Up and down on one line: the comparison must not turn back early.
TEST(Deviation, FollowsAPathThatGoesBackOnItself) {
    const Program program = read_text("G0 X0 Y0 Z0\nG0 Z20\nG0 Z0\nG1 X10 F600\nX0\nX10\nY0.3\nX0\n");
    EXPECT_NEAR(measure_deviation(program, program).greatest, 0, 1e-12);
}

TEST(Optimizer, IsBetterInEveryRespectOrRefuses) {
    const Program program = read_text(wavy_zigzag(7, 10, crowded));
    OptimizeRules rules;
    rules.header = "by a test";
    Diagnostics diagnostics;
    const Optimized result = optimize(program, read_text, brisk(), rules, {}, {}, diagnostics);
    EXPECT_EQ(result.evaluation.accepted, result.evaluation.reason.empty());
    EXPECT_EQ(result.evaluation.defects_before, result.before.report.defects.size());
    EXPECT_EQ(result.evaluation.defects_after, result.after.report.defects.size());
    if (!result.evaluation.accepted) return;
    EXPECT_LT(result.after.mismatch, result.before.mismatch);
    EXPECT_LE(result.after.duration, result.before.duration);
    EXPECT_LE(result.evaluation.defects_after, result.evaluation.defects_before);
    const Program changed = read_text(result.text);
    EXPECT_LE(std::max(farthest(corners_of(changed), corners_of(program)),
                       farthest(corners_of(program), corners_of(changed))),
              rules.tolerance);
    EXPECT_NE(result.text.find("(by a test)"), std::string::npos);
    // Everything but plain lines of passes is kept, in order.
    std::istringstream old(program.main().text().data()), now(result.text);
    std::vector<std::string> kept;
    for (std::string line; std::getline(old, line);) {
        if (!read_plain_line(line)) kept.push_back(line);
    }
    std::size_t next = 0;
    for (std::string line; std::getline(now, line);) {
        if (next < kept.size() && line == kept[next]) ++next;
    }
    EXPECT_EQ(next, kept.size()) << kept[std::min(next, kept.size() - 1)];
}

TEST(Optimizer, SlowsNeighboursDownOnlyInTheTimeThatIsAllowed) {
    // One pass is slower than its neighbours. Feeds are only lowered: every feed reduction takes time.
    std::string text = wavy_zigzag(
        7, 10, [](int, double) { return 0.3; }, 0);
    for (const auto& [begin, feed] : {std::pair{"Y1.2000", " F2700"}, std::pair{"Y1.6000", " F3000"}})
        text.insert(text.find('\n', text.find(begin)), feed);
    const Program program = read_text(text);
    Diagnostics diagnostics;
    OptimizeRules rules;
    const Optimized refused = optimize(program, read_text, brisk(), rules, {}, {}, diagnostics);
    EXPECT_GT(refused.before.report.defects.size(), 0U);
    EXPECT_FALSE(refused.evaluation.accepted && refused.evaluation.defects_after < refused.evaluation.defects_before);
    rules.more_time = 0.1;
    const Optimized taken = optimize(program, read_text, brisk(), rules, {}, {}, diagnostics);
    EXPECT_TRUE(taken.evaluation.accepted) << taken.evaluation.reason;
    EXPECT_EQ(taken.evaluation.defects_after, 0U);
    EXPECT_LT(taken.after.mismatch, 0.5 * taken.before.mismatch);
    EXPECT_GT(taken.after.duration, taken.before.duration);
    EXPECT_LE(taken.after.duration, 1.1 * taken.before.duration);
}

TEST(Optimizer, RepairsTheOnlySlowSectionOfAPart) {
    // 1 mm on one of 41 passes of 20 mm: 0.4 % of the points differ, including those on the adjacent passes.
    const Program program = read_text(wavy_zigzag(
        41, 20, [](int pass, double x) { return pass == 20 && x > 9 && x < 10 ? 0.01 : 0.5; }, 0.1));
    Diagnostics diagnostics;
    OptimizeRules rules;
    rules.machines = 0;
    const Optimized result = optimize(program, read_text, slow_at_short_blocks(), rules, {}, {}, diagnostics);
    EXPECT_LT(result.before.mismatch, least_mismatch * 50);
    EXPECT_GT(result.before.greatest_mismatch, 10);
    EXPECT_TRUE(result.evaluation.accepted) << result.evaluation.reason;
    EXPECT_LT(result.after.greatest_mismatch, 0.5 * result.before.greatest_mismatch);
}

TEST(Optimizer, RefusesWhereNothingCanBeRewritten) {
    std::string text = wavy_zigzag(5, 6, [](int, double) { return 0.3; });
    std::string commented;
    for (const char c : text) commented += c == '\n' ? " (KEEP)\n" : std::string(1, c);
    const Program program = read_text(commented);
    Diagnostics diagnostics;
    const Optimized result = optimize(program, read_text, brisk(), {}, {}, {}, diagnostics);
    EXPECT_FALSE(result.evaluation.accepted);
    EXPECT_EQ(result.evaluation.reason, "no section of the program can be rewritten");
}

TEST(Optimizer, RefusesASinglePass) {
    Diagnostics diagnostics;
    EXPECT_THROW(
        (void)optimize(read_text("G0 X0 Y0 Z0\nG1 X10 F600\nX20\n"), read_text, brisk(), {}, {}, {}, diagnostics),
        InputError);
}

}  // namespace
}  // namespace clsurf::optimizer_test

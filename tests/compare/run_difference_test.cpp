#include "compare/run_difference.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "compare/drifted_run.h"
#include "compare/run_budget.h"
#include "compare/run_report.h"
#include "mapping/line_map.h"
#include "support/made_run.h"

namespace clsurf::run_difference_test {
namespace {

using test::MadeRun;
using test::make_run;
using test::RunRecipe;

/// A surface in which every point of a run cuts.
ClSurface surface_of(const ComparedRun& run, double step_over = 2) {
    ClSurface surface;
    surface.positions = gather(run.path);
    surface.passes.push_back({0, run.path.count - 1, PassKind::cut});
    surface.step_over = step_over;
    surface.neighbours = find_neighbours(surface.positions, surface.passes, ArcLength(surface.positions), step_over);
    return surface;
}

struct Compared {
    RunDifferences differences;
    RunReport report;
};

Compared compare(const MadeRun& a, const MadeRun& b) {
    const ComparedRun run_a = a.run();
    const ComparedRun run_b = b.run();
    const ClSurface surface = surface_of(run_a);
    Compared compared{compare_runs(run_a, surface, run_b), {}};
    compared.report = report_run(run_a, surface, nullptr, run_b, compared.differences);
    return compared;
}

RunAlignment align(const MadeRun& a, const MadeRun& b) {
    return align_runs(gather(a.run().path), gather(b.run().path));
}

/// The largest error [mm of arc length] of path locations, for points of A inside [begin, end].
double worst_error(const MadeRun& a, const MadeRun& b, const RunAlignment& alignment, double begin, double end) {
    double worst = 0;
    for (std::size_t i = 0; i < a.arc_length.size(); ++i) {
        if (a.arc_length[i] < begin || a.arc_length[i] > end) continue;
        const PathLocation& at = alignment.locations[i];
        worst = std::max(worst, at.exists() ? std::abs(b.arc_length_at(at) - a.arc_length[i]) : 1e9);
    }
    return worst;
}

RunRecipe zigzag_recipe() {
    RunRecipe recipe;
    recipe.path = test::rounded_zigzag(20);
    recipe.end = 200;
    return recipe;
}

std::vector<RunDifferenceSection> sections_of(const RunReport& report, RunQuantity q) {
    std::vector<RunDifferenceSection> found;
    for (const RunDifferenceSection& d : report.sections) {
        if (d.quantity == q) found.push_back(d);
    }
    return found;
}

TEST(RunDifference, IsExactlyZeroOfEqualRuns) {
    RunRecipe recipe = zigzag_recipe();
    recipe.pauses = {{10, 0.3}, {57, 2.0}, {200, 0.5}};
    recipe.speed = [](double s) { return s < 100 ? 30.0 : 1.5; };  // many points between two knots
    recipe.off = [](double s) { return Vec3(1e-3 * std::sin(s), 2e-3 * std::cos(3 * s), 1e-3); };
    const MadeRun run = make_run(recipe);
    const Compared c = compare(run, run);
    EXPECT_NEAR(c.report.aligned, c.report.arc_length, 1e-6);
    for (const RunQuantityInfo& info : run_quantity_table()) {
        const Column<float>& values = c.differences.of[index_of(info.quantity)];
        PointIndex known = 0;
        for (const float value : values) {
            if (value == value) ++known;
            ASSERT_FALSE(value == value && value != 0) << info.name << " " << value;
        }
        EXPECT_GT(known, run.log.records / 2) << info.name;
    }
    EXPECT_TRUE(c.report.sections.empty());
}

TEST(RunDifference, SaysWhatOfBIsNotCompared) {
    const MadeRun b = make_run(zigzag_recipe());
    EXPECT_NEAR(compare(b, b).report.aligned_of_b, 200, 0.5);
    RunRecipe recipe = zigzag_recipe();
    recipe.end = 120;
    const RunReport report = compare(make_run(recipe), b).report;
    EXPECT_NEAR(report.arc_length_of_b, 200, 0.5);
    EXPECT_NEAR(report.aligned_of_b, 120, 1);
    EXPECT_NEAR(b.arc_length[static_cast<std::size_t>(report.left_out_of_b.first)], 120, 1);
    EXPECT_EQ(report.left_out_of_b.last, b.log.records - 1);
}

TEST(RunDifference, FindsADipOfSpeed) {
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.speed = [](double s) { return s > 75 && s < 83 ? 27.0 : 30.0; };
    recipe.phase = 0.37;
    const MadeRun b = make_run(recipe);
    const Compared c = compare(a, b);
    const auto found = sections_of(c.report, RunQuantity::speed);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].relative_peak, -0.10, 0.01);
    EXPECT_NEAR(found[0].mean * 60, -180, 30);
    EXPECT_NEAR(found[0].length, 8, 0.8);
    EXPECT_NEAR(a.arc_length[static_cast<std::size_t>(found[0].points.first)], 75, 0.5);
    EXPECT_NEAR(a.arc_length[static_cast<std::size_t>(found[0].points.last)], 83, 0.5);
    EXPECT_NEAR(found[0].time, 8 / 27.0 - 8 / 30.0, 0.004);
    // Heights and lags are the same.
    EXPECT_TRUE(sections_of(c.report, RunQuantity::height).empty());
    EXPECT_TRUE(sections_of(c.report, RunQuantity::following_error).empty());
}

// The same speed on average, but oscillating: v = v0 + a sin ωt has the jerk a ω² |sin ωt|, root mean square a ω²/√2.
TEST(RunDifference, FindsWhereARunIsRougher) {
    constexpr double v0 = 30, hertz = 12, swing = 1;
    constexpr double omega = 2 * std::numbers::pi * hertz;
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.speed = [](double s) {
        // The oscillation grows and fades over 2 mm at its ends: a jump of the acceleration would be rougher than the
        // oscillation.
        const double u = std::clamp(std::min(s - 95, 109 - s) / 2, 0.0, 1.0);
        return v0 + swing * u * u * (3 - 2 * u) * std::sin(omega * (s - 96) / v0);
    };
    const MadeRun b = make_run(recipe);
    const auto found = sections_of(compare(a, b).report, RunQuantity::jerk);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].peak, swing * omega * omega / std::numbers::sqrt2, 0.3 * swing * omega * omega);
    EXPECT_NEAR(a.arc_length[static_cast<std::size_t>(found[0].points.first)], 96, 1.5);
    EXPECT_NEAR(a.arc_length[static_cast<std::size_t>(found[0].points.last)], 108, 1.5);
    const auto back = sections_of(compare(b, a).report, RunQuantity::jerk);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_NEAR(back[0].peak, -found[0].peak, 0.05 * found[0].peak);
}

// A vibration of 125 Hz: a window of 40 ms averages five of its periods. A sin ωt has the jerk A ω³, root mean square
// A ω³/√2, of which a window of five records shows three quarters.
TEST(RunDifference, FindsAVibrationThatIsShorterThanTheUsualWindow) {
    constexpr double v = 30, hertz = 125, amplitude = 0.002;
    constexpr double omega = 2 * std::numbers::pi * hertz;
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.shift = [](double s) {
        return s > 96 && s < 108 ? Vec3(amplitude * std::sin(omega * (s - 96) / v), 0, 0) : Vec3(0, 0, 0);
    };
    const auto found = sections_of(compare(a, make_run(recipe)).report, RunQuantity::jerk);
    ASSERT_EQ(found.size(), 1U);
    const double expected = amplitude * omega * omega * omega / std::numbers::sqrt2;
    EXPECT_GT(found[0].mean, 0.5 * expected);
    EXPECT_LT(found[0].mean, 1.1 * expected);
    EXPECT_NEAR(found[0].length, 12, 3);
}

TEST(RunDifference, ChangesItsSignWhenTheRunsAreSwapped) {
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.speed = [](double s) { return s > 75 && s < 83 ? 27.0 : 30.0; };
    recipe.shift = [](double s) { return s > 120 && s < 150 ? Vec3(0, 0, 0.005) : Vec3(0, 0, 0); };
    const MadeRun b = make_run(recipe);
    const RunReport there = compare(a, b).report;
    const RunReport back = compare(b, a).report;
    ASSERT_EQ(sections_of(there, RunQuantity::speed).size(), sections_of(back, RunQuantity::speed).size());
    for (const RunQuantity q : {RunQuantity::speed, RunQuantity::height}) {
        EXPECT_NEAR(there.find(q)->mean, -back.find(q)->mean, 0.02 * std::abs(there.find(q)->mean)) << index_of(q);
        EXPECT_NEAR(there.find(q)->lowest, -back.find(q)->highest, 0.02 * std::abs(there.find(q)->lowest) + 3e-4)
            << index_of(q);
        EXPECT_NEAR(there.find(q)->highest, -back.find(q)->lowest, 0.02 * std::abs(there.find(q)->highest) + 3e-4)
            << index_of(q);
    }
}

TEST(RunDifference, FindsALagOfThreeMicrometres) {
    RunRecipe recipe = zigzag_recipe();
    const auto path = recipe.path;
    const auto feed = [path](double s) { return Vec3((path(s + 1e-4) - path(s - 1e-4)) / 2e-4); };
    recipe.off = [feed](double s) { return Vec3(-0.010 * feed(s)); };
    const MadeRun a = make_run(recipe);
    recipe.off = [feed](double s) { return Vec3(-(s > 60 && s < 70 ? 0.013 : 0.010) * feed(s)); };
    const Compared c = compare(a, make_run(recipe));
    const auto found = sections_of(c.report, RunQuantity::following_error);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].peak, 0.003, 1e-4);
    EXPECT_NEAR(found[0].length, 10, 0.8);
    EXPECT_NEAR(a.arc_length[static_cast<std::size_t>(found[0].point)], 65, 5);
    EXPECT_TRUE(sections_of(c.report, RunQuantity::height).empty());  // along the feed nothing is higher
}

TEST(RunDifference, FindsAHeightAlongTheNormalOfTheSurface) {
    RunRecipe recipe = zigzag_recipe();
    const Vec3 normal(0, -0.6, 0.8);
    const Vec3 side(0, 0.8, 0.6);
    recipe.off = [](double) -> Vec3 { return Vec3(0.004, 0, 0); };
    const MadeRun a = make_run(recipe);
    recipe.off = [=](double s) -> Vec3 {
        return s > 27 && s < 37 ? Vec3(0.003 * normal + Vec3(0.004, 0, 0)) : Vec3(0.004, 0, 0);
    };
    const Compared c = compare(a, make_run(recipe));
    const auto found = sections_of(c.report, RunQuantity::height);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].peak, 0.003, 1e-4);
    EXPECT_NEAR(found[0].mean, 0.003, 4e-4);
    // A deviation along the surface and across the feed is not a height.
    recipe.off = [=](double s) -> Vec3 {
        return s > 27 && s < 37 ? Vec3(0.003 * side + Vec3(0.004, 0, 0)) : Vec3(0.004, 0, 0);
    };
    EXPECT_TRUE(sections_of(compare(a, make_run(recipe)).report, RunQuantity::height).empty());
}

TEST(RunDifference, IsSmallBetweenSamplingPeriods) {
    RunRecipe recipe = zigzag_recipe();
    recipe.speed = [](double s) { return 30 + 5 * std::sin(s / 3); };
    const MadeRun a = make_run(recipe);
    for (const double period : {0.002, 0.0025, 0.004}) {
        recipe.period = period;
        recipe.phase = 0.4;
        const MadeRun b = make_run(recipe);
        const Compared c = compare(a, b);
        EXPECT_TRUE(c.report.sections.empty()) << period;
        EXPECT_LT(c.report.find(RunQuantity::speed)->p95, 0.15) << period;  // [mm/s] of 30
        const Compared swapped = compare(b, a);
        EXPECT_TRUE(swapped.report.sections.empty()) << period;
    }
}

TEST(RunDifference, TakesAPauseAsOnePlace) {
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.pauses = {{40, 1.5}, {101, 20.0}};
    const MadeRun b = make_run(recipe);
    const Compared c = compare(a, b);
    EXPECT_LT(worst_error(a, b, c.differences.alignment, 0, 200), 1e-3);
    EXPECT_NEAR(c.report.time_of_b - c.report.time, 21.5, 0.01);
    for (const RunDifferenceSection& d : sections_of(c.report, RunQuantity::speed)) {
        const double at = a.arc_length[static_cast<std::size_t>(d.point)];
        EXPECT_TRUE(std::abs(at - 40) < 1 || std::abs(at - 101) < 1) << at;
    }
    EXPECT_EQ(sections_of(c.report, RunQuantity::speed).size(), 2u);
    const Compared swapped = compare(b, a);
    EXPECT_LT(worst_error(b, a, swapped.differences.alignment, 0, 200), 1e-3);
    EXPECT_NEAR(swapped.report.time_of_b - swapped.report.time, -21.5, 0.01);
}

TEST(RunDifference, KeepsTheFeedOverrideApartFromThePlace) {
    RunRecipe recipe = zigzag_recipe();
    const MadeRun a = make_run(recipe);
    recipe.speed = [](double s) { return s < 80 ? 21.0 : 36.0; };
    const MadeRun b = make_run(recipe);
    const Compared c = compare(a, b);
    EXPECT_LT(worst_error(a, b, c.differences.alignment, 0, 199), 1e-3);
    const auto found = sections_of(c.report, RunQuantity::speed);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0].relative_mean, -0.3, 0.01);
    EXPECT_NEAR(found[1].relative_mean, 0.2, 0.01);
}

TEST(RunAlignment, FindsRunsThatBeginAndEndInside) {
    const MadeRun whole = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.begin = 61.3;
    recipe.end = 150.2;
    recipe.period = 0.0007;
    const MadeRun part = make_run(recipe);
    EXPECT_LT(worst_error(part, whole, align(part, whole), 61.3, 150.2), 1e-3);
    const RunAlignment there = align(whole, part);
    EXPECT_LT(worst_error(whole, part, there, 61.6, 150), 1e-3);
    EXPECT_NEAR(there.aligned, 150.2 - 61.3, 0.5);
    for (std::size_t i = 0; i < whole.arc_length.size(); ++i) {
        if (whole.arc_length[i] < 61 || whole.arc_length[i] > 151) {
            EXPECT_FALSE(there.locations[i].exists()) << whole.arc_length[i];
        }
    }
}

TEST(RunAlignment, TellsThePassesOfAContourThatIsCutThreeTimes) {
    RunRecipe recipe;
    recipe.path = test::circles(5, 3);
    const double turn = 2 * std::numbers::pi * 5;
    recipe.end = 3 * turn + 8;
    const MadeRun whole = make_run(recipe);
    recipe.period = 0.0013;
    const MadeRun again = make_run(recipe);
    EXPECT_LT(worst_error(whole, again, align(whole, again), 0, recipe.end - 0.1), 1e-3);
    recipe.begin = turn + 1.234;  // in the second turn: the first looks the same
    const MadeRun late = make_run(recipe);
    EXPECT_LT(worst_error(late, whole, align(late, whole), recipe.begin, recipe.end - 0.1), 1e-3);
}

TEST(RunAlignment, KeepsToItsBranchWhereThePathCrossesItself) {
    RunRecipe recipe;
    recipe.path = test::crossing_curve();
    recipe.end = 700;  // twice and more round the closed curve
    const MadeRun a = make_run(recipe);
    recipe.speed = [](double s) { return 25 + 10 * std::sin(s); };
    recipe.period = 0.002;
    const MadeRun b = make_run(recipe);
    EXPECT_LT(worst_error(a, b, align(a, b), 0, 699), 0.02);
    EXPECT_LT(worst_error(b, a, align(b, a), 0, 699), 0.02);
}

TEST(RunAlignment, ComesBackAfterARetractOfOneRun) {
    RunRecipe recipe = zigzag_recipe();
    const MadeRun plain = make_run(recipe);
    const auto path = recipe.path;
    // At 70 mm the path goes 30 mm up and down again; everything after has 60 mm more arc length.
    recipe.path = [path](double s) -> Vec3 {
        if (s < 70) return path(s);
        if (s > 130) return path(s - 60);
        return path(70) + Vec3(0, 0, s < 100 ? s - 70 : 130 - s);
    };
    recipe.end = 260;
    MadeRun lifted = make_run(recipe);
    for (double& s : lifted.arc_length) s = s < 70 ? s : s > 130 ? s - 60 : 70;
    const RunAlignment there = align(plain, lifted);
    EXPECT_LT(worst_error(plain, lifted, there, 0, 69), 1e-3);
    EXPECT_LT(worst_error(plain, lifted, there, 71, 199), 1e-3);
    const RunAlignment back = align(lifted, plain);
    EXPECT_NEAR(back.aligned, 200, 2);
    EXPECT_EQ(back.sections.size(), 2u);
}

TEST(RunAlignment, LeavesOutWhatOnlyOneRunCuts) {
    RunRecipe recipe = zigzag_recipe();
    const MadeRun a = make_run(recipe);
    const auto path = recipe.path;
    const double piece = 20 + std::numbers::pi;
    // Without the third and fourth pass, straight on from the second to the fifth.
    recipe.path = [=](double s) { return s < 2 * piece ? path(s) : path(s + 2 * piece); };
    recipe.end = 200 - 2 * piece;
    MadeRun b = make_run(recipe);
    for (double& s : b.arc_length) s = s < 2 * piece ? s : s + 2 * piece;
    const RunAlignment alignment = align(a, b);
    EXPECT_LT(worst_error(a, b, alignment, 0, 2 * piece - 0.2), 1e-3);
    EXPECT_LT(worst_error(a, b, alignment, 4 * piece + 0.5, 199), 1e-3);
    EXPECT_NEAR(alignment.aligned, 200 - 2 * piece, 1.0);
}

TEST(RunAlignment, SkipsPositionsThatAreMissing) {
    const MadeRun a = make_run(zigzag_recipe());
    MadeRun b = make_run(zigzag_recipe());
    const auto n = static_cast<std::size_t>(b.log.records);
    for (std::size_t i = 1000; i < 1010; ++i) (*b.columns)[i] = std::nan("");
    for (std::size_t i = 3000; i < 3003; ++i) (*b.columns)[n + i] = std::nan("");
    const RunAlignment there = align(a, b);
    EXPECT_LT(worst_error(a, b, there, 0, 29.9), 1e-3);
    EXPECT_LT(worst_error(a, b, there, 30.5, 89.9), 1e-3);  // beyond the gap of 0.3 mm
    EXPECT_LT(worst_error(a, b, there, 90.2, 199), 1e-3);
    const RunAlignment back = align(b, a);
    EXPECT_FALSE(back.locations[1005].exists());
    EXPECT_TRUE(back.locations[1020].exists());
}

TEST(RunAlignment, FindsNothingOfAnotherPart) {
    RunRecipe recipe = zigzag_recipe();
    const MadeRun a = make_run(recipe);
    recipe.shift = [](double) -> Vec3 { return Vec3(0, 0, 40); };
    const RunAlignment alignment = align(a, make_run(recipe));
    EXPECT_EQ(alignment.aligned, 0);
    EXPECT_TRUE(alignment.sections.empty());
}

TEST(RunBudget, IsHeldAgainstTheGreatestDifferences) {
    const MadeRun a = make_run(zigzag_recipe());
    RunRecipe recipe = zigzag_recipe();
    recipe.speed = [](double s) { return s > 75 && s < 83 ? 27.0 : 30.0; };
    const Compared c = compare(a, make_run(recipe));
    RunBudget budget;
    budget.max_speed_difference_percent = 5;
    budget.max_height_difference_um = 1;
    budget.min_aligned_percent = 99;
    const std::vector<BudgetLine> lines = hold(c.report, budget);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_FALSE(lines[0].held);
    EXPECT_NEAR(lines[0].measured, 10, 1);
    EXPECT_TRUE(lines[1].held);
    EXPECT_TRUE(lines[2].held);
}

TEST(DriftedRun, IsTheOneThatDepartsFromTheOthers) {
    RunRecipe recipe = zigzag_recipe();
    std::vector<MadeRun> runs;
    for (const double step : {1.0, 0.7, 0.4}) {
        recipe.phase = step;
        runs.push_back(make_run(recipe));
    }
    recipe.shift = [](double s) { return Vec3(0, 0, 0.010 * s / 200); };  // it grows: 0 to 10 µm
    runs.push_back(make_run(recipe));
    const auto drifted = [&](const std::vector<std::size_t>& order) {
        const auto a = runs[order[0]].run();
        const ClSurface surface = surface_of(a);
        DriftFinder finder(surface);
        for (std::size_t k = 1; k < order.size(); ++k) finder.add(compare_runs(a, surface, runs[order[k]].run()));
        const std::vector<RunDeparture> departures = finder.departures();
        const std::optional<std::size_t> at = drifted_run(departures);
        if (at) { EXPECT_EQ(departures[*at].quantity, RunQuantity::height); }
        return at ? static_cast<int>(order[*at]) : -1;
    };
    EXPECT_EQ(drifted({0, 1, 3, 2}), 3);
    EXPECT_EQ(drifted({3, 1, 2}), 3);  // the reference itself
    EXPECT_EQ(drifted({0, 1, 2}), -1);
    EXPECT_EQ(drifted({0, 3}), -1);  // two differ from each other: which one drifted is unknown
}

}  // namespace
}  // namespace clsurf::run_difference_test

#include "predictor/defects.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "mapping/map_lines.h"
#include "planted_score.h"
#include "predictor/axis_delay.h"
#include "support/plane_zigzag.h"
#include "surface/smoothing_segments.h"
#include "surface/stitch.h"

namespace clsurf::defects_test {
namespace {

using planted::Shape;
using test::lift;
using test::pass_length;
using test::plane_zigzag;
using test::usual_step_over;

constexpr Shape shapes[] = {Shape::zigzag, Shape::one_way, Shape::loops, Shape::spiral};

class Planted : public testing::TestWithParam<Shape> {};

TEST_P(Planted, DefectsAreFoundAndNothingElse) {
    planted::Score sum;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const planted::PlantedLog log =
            planted::make_planted_log(planted::random_recipe(seed, GetParam(), false, seed == 2));
        sum += planted::score(log, planted::judge(log));
    }
    EXPECT_EQ(sum.found, sum.planted);
    EXPECT_EQ(sum.right, sum.reported);
    EXPECT_EQ(sum.placed, sum.planted);
    EXPECT_EQ(sum.lined, sum.planted);
    EXPECT_EQ(sum.named, sum.planted);
    for (const double error : sum.depth_errors) EXPECT_NEAR(error, 0, 0.15);
}

TEST_P(Planted, ACleanLogIsClean) {
    for (std::uint64_t seed = 11; seed <= 12; ++seed) {
        const planted::PlantedLog log =
            planted::make_planted_log(planted::random_recipe(seed, GetParam(), true, false));
        const QualityReport report = planted::judge(log);
        EXPECT_TRUE(report.defects.empty()) << planted::name_of(GetParam()) << " seed " << seed;
        EXPECT_GT(report.compared, report.points / 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Planted, testing::ValuesIn(shapes), [](const auto& shape) {
    std::string name(planted::name_of(shape.param));
    std::erase(name, '-');
    return name;
});

TEST(Defects, AreTheSameForAnyNumberOfThreads) {
    const planted::PlantedLog log = planted::make_planted_log(planted::random_recipe(5, Shape::zigzag, false, false));
    set_thread_count(1);
    const QualityReport one = planted::judge(log);
    set_thread_count(4);
    const QualityReport four = planted::judge(log);
    set_thread_count(0);
    ASSERT_EQ(one.defects.size(), four.defects.size());
    ASSERT_FALSE(one.defects.empty());
    for (std::size_t i = 0; i < one.defects.size(); ++i) {
        EXPECT_EQ(one.defects[i].point, four.defects[i].point);
        EXPECT_EQ(one.defects[i].depth, four.defects[i].depth);
        EXPECT_EQ(one.defects[i].area, four.defects[i].area);
    }
}

TEST(Defects, DoNotDependOnWhereTheRecordBegins) {
    // Places are judged by position, independent of the number of records.
    const auto judged_without = [](PointIndex records) {
        planted::PlantedLog log = planted::make_planted_log(planted::random_recipe(5, Shape::zigzag, false, true));
        for (auto* columns : {&log.commanded, &log.measured}) {
            for (std::vector<double>& column : *columns) column.erase(column.begin(), column.begin() + records);
        }
        log.line.erase(log.line.begin(), log.line.begin() + records);
        log.pass.erase(log.pass.begin(), log.pass.begin() + records);
        return planted::judge(log);
    };
    const QualityReport whole = judged_without(0);
    ASSERT_GE(whole.defects.size(), 2U);
    for (const PointIndex records : {1, 2, 3, 4}) {
        const QualityReport later = judged_without(records);
        ASSERT_EQ(later.defects.size(), whole.defects.size());
        for (std::size_t k = 0; k < whole.defects.size(); ++k) {
            EXPECT_EQ(later.defects[k].point + records, whole.defects[k].point);
            EXPECT_NEAR(later.defects[k].length, whole.defects[k].length, 1e-4);
            EXPECT_NEAR(later.defects[k].depth, whole.defects[k].depth, 2e-5);
        }
    }
}

TEST(Defects, AreNotJudgedOnDataThatCannotShowThem) {
    const auto reasons = [](const planted::PlantedLog& log) { return planted::judge(log).judgement.reasons; };
    planted::PlantedLog log = planted::make_planted_log(planted::random_recipe(5, Shape::zigzag, false, false));
    EXPECT_TRUE(reasons(log).empty());
    // The same position is repeated for records that were lost.
    planted::PlantedLog with_placeholder = log;
    for (const std::size_t at : {1000, 2000, 3000}) {
        for (const std::size_t i : {at, at + 1}) {
            with_placeholder.commanded[0][i] = 198;
            with_placeholder.commanded[1][i] = 158;
            with_placeholder.commanded[2][i] = 119;
        }
    }
    const std::vector<std::string> why = reasons(with_placeholder);
    ASSERT_EQ(why.size(), 1U);
    EXPECT_NE(why.front().find("jumps to X198 Y158"), std::string::npos) << why.front();
    // One record per 100 ms.
    log.recipe.period = 0.1;
    ASSERT_EQ(reasons(log).size(), 1U);
    EXPECT_EQ(reasons(log).front().find("A record comes every 100 ms."), 0U);
}

TEST(Defects, OfARecordedPartAreWhereTheProgramHasThem) {
    // Five passes of the sample have a section of points 0.02 mm apart, where the kernel slows down from
    // 3000 to some 600 mm/min (data/programs/README.md).
    const Program program = io::read_program(SAMPLE_DATA "/programs/bottle_uneven.nc");
    const Log log = io::open_log(SAMPLE_LOGS "/bottle_uneven.biip", {});
    Diagnostics diagnostics;
    const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
    const Trajectory measured = reconstruct(log, Role::feedback, Vec3::Zero());
    const LineMap lines = map_lines(path, log, program, true, diagnostics);
    const ClSurface surface = stitch(gather(path), lines);
    const Signals signals = derive_signals(surface, path, &measured, smoothing_segments(log, surface.passes), 1.0);
    const QualityReport report = find_defects(surface, signals, lines, program, log.period, {});
    for (const double y : {-5.6, -2.8, 0.0, 2.8, 5.6}) {
        const auto here = std::find_if(report.defects.begin(), report.defects.end(), [&](const Defect& d) {
            return d.cause == Cause::point_spacing && d.speed_jump < -30 && d.bounds.min().y() < y + 0.1 &&
                   d.bounds.max().y() > y - 0.1;
        });
        ASSERT_NE(here, report.defects.end()) << "y = " << y;
        // The dense lines: their pass holds more than a hundred of them.
        const bool dense = std::any_of(here->sections.begin(), here->sections.end(), [](const DefectSection& section) {
            return section.last_line - section.first_line > 100;
        });
        EXPECT_TRUE(dense) << "y = " << y;
    }
}

/// Speed at the arc length s with an acceleration [mm/s²] from 1 mm/s.
double reached(double acceleration, double s) { return std::sqrt(1 + 2 * acceleration * s); }

/// On each pass the speed halves around a place that is 0.3 mm farther on every pass: along an
/// edge at 45° to the feed. `steady`: a pass that does not slow down; −1: none.
planted::PlantedLog slow_along_an_edge(int steady) {
    return plane_zigzag([steady](int k, double x, double s) {
        const double off = (x - 8 - k * usual_step_over) / 0.7;
        return std::min(reached(600, std::min(s, pass_length - s)),
                        k == steady ? 50.0 : 50 - 25 * std::exp(-off * off));
    });
}

/// The tool accelerates over 7 mm and brakes over 2, so that the two directions differ near both ends; pass 12
/// differs by `share` more from x = 3 to 5, inside the ramp.
planted::PlantedLog unlike_ramps(double share) {
    return plane_zigzag([share](int k, double x, double s) {
        const double planned = std::min({66.7, reached(300, s), reached(1100, pass_length - s)});
        return k == 12 && x > 3 && x < 5 ? (1 + share) * planned : planned;
    });
}

TEST(Defects, AreNotWhatAllPassesDoOneAfterTheOther) {
    EXPECT_TRUE(planted::judge(slow_along_an_edge(-1)).defects.empty());
    // A pass that does not slow down where the others do is a defect.
    const QualityReport report = planted::judge(slow_along_an_edge(12));
    EXPECT_TRUE(std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& d) {
        return std::abs(d.place.tip.y() - 3.6) < 1e-3 && std::abs(d.place.tip.x() - 11.6) < 1 && d.speed_jump > 5;
    }));
}

TEST(Defects, AreNotHowPassesBeginAndEnd) {
    EXPECT_TRUE(planted::judge(unlike_ramps(0)).defects.empty());
    for (const double share : {-0.2, 0.2}) {
        const QualityReport report = planted::judge(unlike_ramps(share));
        ASSERT_EQ(report.defects.size(), 1U) << share;
        EXPECT_NEAR(report.defects[0].place.tip.y(), 12 * usual_step_over, 1e-3);
        EXPECT_NEAR(report.defects[0].place.tip.x(), 4, 1.5);
        // Compared with its own direction: 50 mm/s at x = 4. The other direction still has 66.7.
        EXPECT_NEAR(report.defects[0].speed_jump, 50 * share, 1);
    }
}

TEST(Defects, OfFastPassesAreSeenByTheirLength) {
    // 100 mm/s and a wave of 1 mm: ten points of a millisecond.
    planted::Recipe recipe;
    recipe.feed = 100;
    recipe.length = 60;
    recipe.width = 10;
    recipe.noise = 1e-4;
    recipe.scatter = 0;
    recipe.quantum = 1e-4;
    recipe.defects = {{.kind = planted::Kind::oscillation,
                       .first_pass = 12,
                       .last_pass = 12,
                       .from = 20,
                       .to = 24,
                       .amplitude = 0.08}};
    const planted::PlantedLog log = planted::make_planted_log(recipe);
    const planted::Score score = planted::score(log, planted::judge(log));
    EXPECT_EQ(score.found, 1);
    EXPECT_EQ(score.named, 1);
    EXPECT_EQ(score.right, score.reported);
}

/// A zigzag whose axes run 10 µm above the path in one direction and 10 µm below it in the other, for x = 4 to 20.
planted::PlantedLog alternating_zigzag() {
    planted::PlantedLog log = plane_zigzag([](int, double, double) { return 50.0; });
    lift(log, 0.010, 4, 20, [](int pass) { return pass % 2 == 0; });
    lift(log, -0.010, 4, 20, [](int pass) { return pass % 2 == 1; });
    return log;
}

TEST(SystematicLag, IsOneDefectOfTheWhole) {
    const QualityReport report = planted::judge(alternating_zigzag());
    ASSERT_EQ(report.defects.size(), 1U);
    const Defect& lag = report.defects.front();
    EXPECT_TRUE(lag.systematic);
    EXPECT_EQ(lag.cause, Cause::lag_step);
    EXPECT_NEAR(lag.depth, 0.020, 0.002);  // between the directions
    EXPECT_NEAR(lag.share, 16.0 / 24.0, 0.05);
    EXPECT_NEAR(lag.bounds.min().x(), 4, 0.5);
    EXPECT_NEAR(lag.bounds.max().x(), 20, 0.5);
    EXPECT_GE(lag.sections.size(), 20U);
    EXPECT_LE(lag.severity, 3);
}

TEST(SystematicLag, LeavesALocalFaultInsideItToItself) {
    for (const int pass : {9, 12}) {
        planted::PlantedLog log = alternating_zigzag();
        lift(log, 0.009, 10, 13, [pass](int p) { return p == pass; });
        const QualityReport report = planted::judge(log);
        ASSERT_EQ(report.defects.size(), 2U);
        const Defect& local = report.defects[report.defects[0].systematic ? 1 : 0];
        EXPECT_FALSE(local.systematic);
        EXPECT_NEAR(local.depth, 0.009, 0.001);
        EXPECT_FALSE(local.pit);
        ASSERT_EQ(local.sections.size(), 1U);
        EXPECT_EQ(local.sections[0].pass, pass + 1);
        EXPECT_GE(local.bounds.min().x(), 9.5);
        EXPECT_LE(local.bounds.max().x(), 13.5);
    }
}

TEST(SystematicLag, IsNoFaultOfAFewPasses) {
    // Four passes of the same direction, in a part without defects: an ordinary defect.
    planted::PlantedLog log = plane_zigzag([](int, double, double) { return 50.0; });
    lift(log, 0.010, 4, 20, [](int p) { return p >= 8 && p <= 14 && p % 2 == 0; });
    const QualityReport report = planted::judge(log);
    ASSERT_FALSE(report.defects.empty());
    for (const Defect& defect : report.defects) EXPECT_FALSE(defect.systematic);
}

TEST(SystematicLag, NamesTheAxesThatDiffer) {
    // A zigzag over a slope: X lags by 0.4 ms, Z by 1.8 ms. Speeds are constant, so that an axis is where it was commanded
    // earlier.
    planted::Recipe recipe = planted::random_recipe(3, Shape::zigzag, true, false);
    recipe.noise = 0;
    planted::PlantedLog planted = planted::make_planted_log(recipe);
    constexpr std::array<double, 3> delays{0.0004, 0.0004, 0.0018};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& commanded = planted.commanded[axis];
        for (std::size_t i = 2; i + 2 < commanded.size(); ++i)
            planted.measured[axis][i] =
                commanded[i] - delays[axis] * (commanded[i + 2] - commanded[i - 2]) / (4 * recipe.period);
    }
    const Log log = planted::as_log(planted);
    const Program program = planted::program_of(planted);
    Diagnostics diagnostics;
    const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
    const Trajectory measured = reconstruct(log, Role::feedback, Vec3::Zero());
    const LineMap lines = map_lines(path, log, program, true, diagnostics);
    const ClSurface surface = stitch(gather(path), lines);
    const Signals signals = derive_signals(surface, path, &measured, smoothing_segments(log, surface.passes),
                                           usual_end_zone(surface.step_over));
    QualityReport report = find_defects(surface, signals, lines, program, log.period, {});
    explain_systematic_lag(report, path, measured, signals);
    const auto lag =
        std::find_if(report.defects.begin(), report.defects.end(), [](const Defect& d) { return d.systematic; });
    ASSERT_NE(lag, report.defects.end());
    ASSERT_EQ(lag->delays.size(), 2U);
    EXPECT_EQ(lag->delays[0].axis, 'z');
    EXPECT_NEAR(lag->delays[0].delay, 0.0018, 1e-4);
    EXPECT_EQ(lag->delays[1].axis, 'x');
    EXPECT_NEAR(lag->delays[1].delay, 0.0004, 1e-4);
}

TEST(Severity, ComesFromDepthAndFromHowFarItStandsOut) {
    const SeverityRule rule;
    const auto of = [&](double depth, float score, bool motion, bool systematic = false) {
        return severity_of({depth, score, motion, systematic}, rule);
    };
    EXPECT_EQ(of(0.0015, 1.2F, false), 1);
    EXPECT_EQ(of(0.003, 1.2F, false), 2);
    EXPECT_EQ(of(0.008, 1.2F, false), 2);  // deep, but hardly more than the part itself
    EXPECT_EQ(of(0.008, 2, false), 3);
    EXPECT_EQ(of(0.030, 2, false), 3);
    EXPECT_EQ(of(0.030, 7, false), 4);
    EXPECT_EQ(of(0.030, 7, false, true), 3);
    EXPECT_EQ(of(0, 2.5F, true), 2);
    EXPECT_EQ(of(0, 20, true), 3);
    EXPECT_EQ(of(0, 20, false), 1);
}

TEST(Defects, AreListedByHowFarTheyStandOut) {
    // A pass 40 % slower has almost no depth here, unlike one 6 µm too deep: the first exceeds thirteen thresholds, the
    // second four.
    planted::PlantedLog log =
        plane_zigzag([](int k, double x, double) { return k == 8 && x > 8 && x < 12 ? 30.0 : 50.0; });
    lift(log, -0.006, 10, 14, [](int p) { return p == 16; });
    const QualityReport report = planted::judge(log);
    ASSERT_EQ(report.defects.size(), 2U);
    EXPECT_EQ(report.defects[0].quantity, Quantity::speed);
    EXPECT_EQ(report.defects[1].quantity, Quantity::normal_deviation);
    EXPECT_GT(report.defects[0].score, report.defects[1].score);
    EXPECT_NEAR(report.defects[0].score, 0.4 / report.thresholds.of[index_of(Quantity::speed)], 0.3);
    EXPECT_LT(report.defects[0].depth, report.defects[1].depth);
    EXPECT_NEAR(report.defects[0].speed_mismatch, -0.4, 0.02);
    EXPECT_NEAR(report.defects[0].speed_jump, -20, 1);
}

TEST(Defects, NearTheBorderAreOfThePassesAtFault) {
    // Passes 0 to 23 of the zigzag: one, or two side by side, 30 % slower; numbers of passes count from 1.
    for (const std::pair<int, int>& slow : {std::pair(1, 1), std::pair(2, 2), std::pair(2, 3), std::pair(3, 4),
                                            std::pair(21, 21), std::pair(22, 22), std::pair(20, 21)}) {
        const int first = slow.first, last = slow.second;
        const planted::PlantedLog log = plane_zigzag(
            [&](int k, double x, double) { return k >= first && k <= last && x > 8 && x < 12 ? 35.0 : 50.0; });
        const QualityReport report = planted::judge(log);
        ASSERT_EQ(report.defects.size(), 1U) << first;
        EXPECT_EQ(report.defects[0].sections.front().pass, first + 1);
        EXPECT_EQ(report.defects[0].sections.back().pass, last + 1);
        EXPECT_NEAR(report.defects[0].speed_mismatch, -0.3, 0.01) << first;
    }
}

TEST(Defects, OfASmallDipOfSpeedAreAsSevereHoweverCleanTheLogIs) {
    // 5 % slower: 1.67 times the threshold. Positions with a resolution of a nanometre and of a micrometre.
    for (const double step : {1e-6, 1e-3}) {
        planted::PlantedLog log =
            plane_zigzag([](int k, double x, double) { return k == 11 && x > 8 && x < 12 ? 47.5 : 50.0; });
        for (auto* columns : {&log.commanded, &log.measured}) {
            for (std::vector<double>& axis : *columns) {
                for (double& p : axis) p = step * std::round(p / step);
            }
        }
        const QualityReport report = planted::judge(log);
        ASSERT_EQ(report.defects.size(), 1U) << step;
        EXPECT_NEAR(report.defects[0].score, 0.05 / 0.03, 0.1) << step;
        EXPECT_EQ(report.defects[0].severity, 1) << step;
    }
}

TEST(Defects, LoseAtMostAllOfTheirSpeed) {
    // The neighbours of this pass are slow where it is fast: three times as fast is +200 %, and nothing is −200 %.
    const planted::PlantedLog log = plane_zigzag([](int k, double x, double) {
        const bool odd_one = k == 12;
        return x > 8 && x < 14 ? (odd_one ? 50.0 : 15.0) : (odd_one ? 40.0 : 50.0);
    });
    const QualityReport report = planted::judge(log);
    ASSERT_FALSE(report.defects.empty());
    for (const Defect& defect : report.defects) {
        EXPECT_GE(defect.speed_mismatch, -1);
        EXPECT_EQ(defect.speed_mismatch < 0, defect.speed_jump < 0);
    }
}

TEST(Defects, AreNotJudgedWherePassesHaveNoNeighbours) {
    // The passes are in pairs, far from each other: each has a neighbour on one side only.
    planted::PlantedLog log = plane_zigzag([](int, double, double) { return 50.0; });
    EXPECT_TRUE(planted::judge(log).judgement.judged());
    for (std::size_t i = 0; i < log.pass.size(); ++i) {
        for (auto* columns : {&log.commanded, &log.measured}) (*columns)[1][i] += 40.0 * (log.pass[i] / 2);
    }
    const QualityReport report = planted::judge(log);
    EXPECT_LT(report.coverage(), least_coverage);
    EXPECT_FALSE(report.judgement.judged());
    // Of the 480 records of a pass, 20 are within 1 mm of one end and 19 of the other. The rest has a neighbour on one side
    // only.
    ASSERT_EQ(report.judgement.reasons.size(), 1U);
    const std::string& reason = report.judgement.reasons.front();
    EXPECT_NE(reason.find("8.1 % lie near the ends of passes"), std::string::npos) << reason;
    EXPECT_NE(reason.find("91.9 % have no adjacent pass on one side"), std::string::npos) << reason;
}

}  // namespace
}  // namespace clsurf::defects_test

// When a level changes, which runs stand out, which defects are the same: answers computed by hand or published.

#include "history/trend.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "history/outliers.h"
#include "history/run_comparison.h"

namespace clsurf::trend_test {
namespace {

RunRecord run_of(std::int64_t id, double score, const std::string& tool = "") {
    RunRecord run;
    run.id = id;
    run.time = "2026-11-24T07:30:00Z";
    run.program = "part.nc";
    run.program_sha256 = "p";
    run.judged = true;
    run.worst_score = score;
    if (!tool.empty()) run.parameters.push_back({"tool", tool});
    return run;
}

RecordedDefect defect_at(double x, const std::string& cause = "feed_drop", int severity = 2, LineNumber line = 0) {
    RecordedDefect defect;
    defect.cause = cause;
    defect.severity = severity;
    defect.tip = Vec3(x, 0, 0);
    defect.score = severity;
    defect.sections.push_back({7, line, line});
    return defect;
}

TEST(Change, OfALevelIsFoundAtItsFirstRun) {
    // Ranks 1…4, then 5…8: |U| is greatest after the fourth, 2·10 − 4·9 = −16; p = 2 exp(−6·256/(512 + 64)) = 0.139.
    const std::array<double, 8> short_one{1, 2, 3, 4, 11, 12, 13, 14};
    EXPECT_FALSE(find_change(short_one));
    // Six and six: U = 2·21 − 6·13 = −36; p = 2 exp(−6·1296/(1728 + 144)) = 0.0314.
    const std::array<double, 12> values{1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16};
    const auto change = find_change(values);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->first, 6U);
    EXPECT_DOUBLE_EQ(change->before, 3.5);
    EXPECT_DOUBLE_EQ(change->after, 13.5);
    EXPECT_NEAR(change->p, 2 * std::exp(-6.0 * 1296 / 1872), 1e-12);
}

/// Pettitt's statistic by its definition: the sum of the signs of all differences across the place.
int sum_of_signs(std::span<const double> values, std::size_t first) {
    int sum = 0;
    for (std::size_t i = 0; i < first; ++i) {
        for (std::size_t j = first; j < values.size(); ++j) sum += (values[i] > values[j]) - (values[i] < values[j]);
    }
    return sum;
}

TEST(Change, OfTheNileIsThatOf1899) {
    // Annual flow of the Nile at Aswan 1871–1970 [10⁸ m³]: it decreased in 1899, when the first dam was built (Cobb 1978).
    const std::array<double, 100> nile{
        1120, 1160, 963,  1210, 1160, 1160, 813,  1230, 1370, 1140, 995,  935,  1110, 994, 1020, 960,  1180,
        799,  958,  1140, 1100, 1210, 1150, 1250, 1260, 1220, 1030, 1100, 774,  840,  874, 694,  940,  833,
        701,  916,  692,  1020, 1050, 969,  831,  726,  456,  824,  702,  1120, 1100, 832, 764,  821,  768,
        845,  864,  862,  698,  845,  744,  796,  1040, 759,  781,  865,  845,  944,  984, 897,  822,  1010,
        771,  676,  649,  846,  812,  742,  801,  1040, 860,  874,  848,  890,  744,  749, 838,  1050, 918,
        986,  797,  923,  975,  815,  1020, 906,  901,  1170, 912,  746,  919,  718,  714, 740};
    const auto change = find_change(nile);
    ASSERT_TRUE(change);
    EXPECT_EQ(1871 + static_cast<int>(change->first), 1899);
    const int most = sum_of_signs(nile, change->first);
    for (std::size_t first = 1; first < nile.size(); ++first) EXPECT_LE(std::abs(sum_of_signs(nile, first)), most);
    EXPECT_NEAR(change->p, 2 * std::exp(-6.0 * most * most / (1e6 + 1e4)), 1e-12);
}

TEST(Change, IsNoneInEqualValuesAndInFew) {
    EXPECT_FALSE(find_change(std::vector<double>(50, 3.0)));
    EXPECT_FALSE(find_change(std::vector<double>{0, 0, 0, 9, 9}));
    EXPECT_FALSE(find_change(std::vector<double>{}));
}

TEST(Trend, GroupsAreThoseOfAParameterAndTheWorstComesFirst) {
    std::vector<RunRecord> runs{run_of(1, 1, "D8"), run_of(2, 6, "D6"), run_of(3, 2, "D8"), run_of(4, 8, "D6")};
    runs.push_back(run_of(5, 100, "D6"));
    runs.back().judged = false;  // has no value
    const Trend trend = make_trend(runs, find_history_quantity("worst_score"), {}, "tool");
    ASSERT_EQ(trend.groups.size(), 2U);
    EXPECT_EQ(trend.groups[0].name, "D6");
    EXPECT_EQ(trend.groups[0].runs, 2U);
    EXPECT_DOUBLE_EQ(trend.groups[0].median, 7);
    EXPECT_DOUBLE_EQ(trend.groups[1].most, 2);
    EXPECT_TRUE(std::isnan(trend.points[4].value));
}

TEST(Trend, OfAPassCountsItsDefectsOnly) {
    std::vector<RunRecord> runs{run_of(1, 9)};
    runs[0].found = {defect_at(0, "feed_drop", 4, 100), defect_at(9, "corner", 2, 200)};
    runs[0].found[1].sections[0].pass = 8;
    const HistoryQuantity& worst = find_history_quantity("worst_severity");
    DefectFilter filter;
    filter.pass = 8;
    EXPECT_DOUBLE_EQ(make_trend(runs, worst, filter, "").points[0].value, 2);
    filter.pass = 9;
    EXPECT_DOUBLE_EQ(make_trend(runs, worst, filter, "").points[0].value, 0);
    filter = {};
    filter.lines = {90, 100};
    EXPECT_DOUBLE_EQ(make_trend(runs, worst, filter, "").points[0].value, 4);
    filter.cause = "corner";
    EXPECT_DOUBLE_EQ(make_trend(runs, worst, filter, "").points[0].value, 0);
    EXPECT_THROW(static_cast<void>(make_trend(runs, find_history_quantity("ra_um"), filter, "")), UsageError);
}

TEST(Change, NeedsElevenRuns) {
    // K = 5 · 5 of ten runs: p = 2 exp(−6 · 25²/1100) = 0.066. K = 5 · 6 of eleven: 2 exp(−6 · 30²/1452) = 0.0485.
    EXPECT_FALSE(find_change(std::vector<double>{0, 0, 0, 0, 0, 9, 9, 9, 9, 9}));
    const std::optional<TrendChange> change = find_change(std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    ASSERT_TRUE(change);
    EXPECT_NEAR(change->p, 0.0485, 5e-5);
}

TEST(Outliers, HaveTheScoresOfTheBook) {
    // Iglewicz and Hoaglin: median 3.42, MAD 0.42 of the sample 2.1, 2.6, 2.4, 2.5, 2.3, 2.1, 2.3, 2.6, 8.2, 8.3 have
    // medians 2.45 and deviations' median 0.15: (8.2 − 2.45) · 0.6745 / 0.15 = 25.856, (8.3 − 2.45) · … = 26.305.
    const std::vector<double> z = modified_z_scores(std::array{2.1, 2.6, 2.4, 2.5, 2.3, 2.1, 2.3, 2.6, 8.2, 8.3});
    EXPECT_NEAR(z[8], 0.6745 * 5.75 / 0.15, 1e-9);
    EXPECT_NEAR(z[9], 0.6745 * 5.85 / 0.15, 1e-9);
    EXPECT_NEAR(z[0], -0.6745 * 0.35 / 0.15, 1e-9);
}

TEST(Outliers, AmongEqualValuesUseTheMeanDeviation) {
    const std::vector<double> z = modified_z_scores(std::array{1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 6.0});
    EXPECT_NEAR(z[9], 5 / (1.253314 * 0.5), 1e-9);
    EXPECT_TRUE(modified_z_scores(std::array{2.0, 2.0, 2.0}).empty());
}

TEST(Outliers, AreLookedForAmongTheRunsOfOneProgram) {
    std::vector<RunRecord> runs;
    for (int i = 0; i < 9; ++i) runs.push_back(run_of(i + 1, 2 + 0.1 * (i % 3)));
    runs.push_back(run_of(10, 40));
    runs.push_back(run_of(11, 40));
    runs.back().program_sha256 = "another";  // its only run: usual there
    const std::vector<RunOutlier> outliers = find_outliers(runs);
    ASSERT_FALSE(outliers.empty());
    for (const RunOutlier& outlier : outliers) EXPECT_EQ(outlier.run, 9U) << outlier.quantity->name;
}

TEST(Match, EachDefectIsFoundAgainOnce) {
    const std::vector<RecordedDefect> known{defect_at(0), defect_at(100), defect_at(200, "corner")};
    const std::vector<RecordedDefect> now{defect_at(1), defect_at(2), defect_at(100, "feed_drop", 4), defect_at(50)};
    const RecordedMatch match = match_recorded(known, now);
    EXPECT_EQ(match.states,
              (std::vector{DefectState::unchanged, DefectState::fresh, DefectState::worse, DefectState::fresh}));
    EXPECT_EQ(match.gone, std::vector<std::size_t>{2});
    EXPECT_EQ(match.worsened(), 3U);
}

TEST(Match, CommonLinesAreTheSamePlace) {
    const std::vector<RecordedDefect> known{defect_at(0, "feed_drop", 2, 500)};
    EXPECT_EQ(match_recorded(known, std::vector{defect_at(40, "feed_drop", 2, 500)}).worsened(), 0U);
    EXPECT_EQ(match_recorded(known, std::vector{defect_at(40, "feed_drop", 2, 501)}).worsened(), 1U);
    EXPECT_EQ(match_recorded(known, std::vector{defect_at(0, "corner", 2, 500)}).worsened(), 1U) << "another cause";
}

TEST(Comparison, TheBestRunIsOfTheSameProgram) {
    std::vector<RunRecord> runs{run_of(1, 5), run_of(2, 1), run_of(3, 4), run_of(4, 0)};
    runs[1].program_sha256 = "another";
    EXPECT_EQ(best_run(runs, runs[3])->id, 3);
    EXPECT_EQ(best_run(runs, runs[0])->id, 4);
    EXPECT_EQ(best_run(runs, runs[1]), nullptr);
}

}  // namespace
}  // namespace clsurf::trend_test

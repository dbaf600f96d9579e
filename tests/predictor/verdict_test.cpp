// The verdict: the limits of a budget that a report meets.
#include "predictor/verdict.h"

#include <gtest/gtest.h>

#include "predictor/coverage.h"

namespace clsurf::verdict_test {
namespace {

TEST(Verdict, HoldsEveryLimitThatIsSet) {
    QualityReport report;
    report.points = 100;
    report.compared = 80;
    report.defects.resize(2);
    report.defects[0].depth = 0.006;
    report.defects[0].severity = 3;
    report.defects[0].speed_mismatch = 0.25;
    EXPECT_TRUE(hold(report, {}).empty());
    QualityBudget budget;
    budget.max_depth_um = 6;
    budget.max_defects = 2;
    budget.max_speed_mismatch_percent = 25;
    budget.min_coverage_percent = 80;
    EXPECT_TRUE(all_held(hold(report, budget)));
    budget.max_depth_um = 5.9;
    EXPECT_FALSE(all_held(hold(report, budget)));
    budget.max_depth_um = 6;
    budget.min_coverage_percent = 81;
    EXPECT_FALSE(all_held(hold(report, budget)));
    budget.min_coverage_percent.reset();
    budget.max_severity = 2;
    const std::vector<BudgetLine> lines = hold(report, budget);
    EXPECT_FALSE(all_held(lines));
    EXPECT_EQ(lines.size(), 4U);
}

TEST(Verdict, IsNeverThatABudgetIsMetWhereNothingWasJudged) {
    QualityReport report;
    report.points = 100;
    report.compared = 80;
    QualityBudget budget;
    budget.max_depth_um = 6;
    EXPECT_TRUE(all_held(hold(report, budget)));
    report.judgement.refuse("Every position is the same.");
    report.judgement.refuse("Every position is the same.");
    EXPECT_FALSE(report.judgement.judged());
    EXPECT_EQ(report.judgement.reasons.size(), 1U);
    EXPECT_FALSE(all_held(hold(report, budget)));
}

TEST(Verdict, IsNoneWherePassesLieAboveEachOther) {
    QualityReport report;
    report.points = 100;
    report.away_from_ends = report.compared = 80;
    report.step_over = 0.3;
    report.thresholds.of[index_of(Quantity::relief)] = 0.14F;
    judge_coverage(0.1, report);
    EXPECT_TRUE(report.judgement.judged());
    report.thresholds.of[index_of(Quantity::relief)] = 0.2F;
    judge_coverage(0.1, report);
    ASSERT_EQ(report.judgement.reasons.size(), 1U);
    EXPECT_NE(report.judgement.reasons[0].find("differ by up to 200 µm"), std::string::npos);
}

}  // namespace
}  // namespace clsurf::verdict_test

// The objective of a repair, and what an ensemble of machines accepts.

#include "repair/objective.h"

#include <gtest/gtest.h>

#include "repair/ensemble.h"

namespace clsurf::objective_test {
namespace {

constexpr RunMeasures before{.mismatch = 10, .defects = 20, .duration = 100};

// By hand: 0.03·2 + 0.8 + 0.1·0.5 + 10/20 = 1.41; below half of the mismatch only a tenth counts: 0.03 + 0.5 + 0.1·0.2 + 0.5.
TEST(Objective, AddsTheSharesThatRemain) {
    EXPECT_DOUBLE_EQ(objective(before, before, 1, 0), 0.03 + 1 + 0.05 + 1);
    EXPECT_DOUBLE_EQ(objective(before, {8, 10, 100}, 2, 0), 1.41);
    EXPECT_DOUBLE_EQ(objective(before, {2, 10, 90}, 1, 0), 1.05);
    EXPECT_DOUBLE_EQ(objective(before, {2, 10, 103}, 1, 0.05), 1.08) << "3 % more time, of 5 % that are allowed";
    EXPECT_DOUBLE_EQ(objective({10, 0, 100}, {10, 2, 100}, 1, 0), 0.03 + 1.05 + 2) << "defects where there were none";
    EXPECT_DOUBLE_EQ(objective({0.02, 20, 100, 50}, {0.08, 20, 100, 50}, 1, 0), 0.03 + 1.05 + 1) << "0.1 mm/s is none";
    EXPECT_DOUBLE_EQ(gain_of(before, before, 1, 0), 0);
    EXPECT_DOUBLE_EQ(gain_of(before, {8, 10, 100}, 2, 0), 1 - 1.41 / 2.08);
}

TEST(Objective, SaysWhichGainIsTooLittle) {
    EXPECT_EQ(too_little_gain("the gain", 0.02), "");
    EXPECT_EQ(too_little_gain("the gain", 0.0131), "the gain is 1.3 %, less than 2 %");
    EXPECT_EQ(too_little_gain("the gain", -0.0004), "the gain is 0.0 %, less than 2 %");
    EXPECT_EQ(too_little_gain("the gain", -0.031), "the gain is -3.1 %, less than 2 %");
}

TEST(Objective, EveryMeasureMustNotBeWorse) {
    EXPECT_EQ(why_not_better(before, {9, 20, 100}, 0), "");
    EXPECT_NE(why_not_better(before, {10, 19, 100}, 0), "") << "the same mismatch";
    EXPECT_NE(why_not_better(before, {9, 21, 100}, 0), "");
    EXPECT_NE(why_not_better(before, {9, 20, 100.1}, 0), "");
    EXPECT_EQ(why_not_better(before, {9, 20, 100.1}, 0.01), "");
    EXPECT_EQ(why_not_better({0.02, 20, 100, 50}, {0.08, 10, 100, 50}, 0), "") << "no mismatch before and after";
    EXPECT_NE(why_not_better({0.02, 20, 100, 50}, {0.12, 10, 100, 50}, 0), "");
}

// One slow section on one of a hundred passes: it does not change the 95th percentile.
TEST(Objective, DefectsAloneCountWhereThe95thPercentileIsNone) {
    const RunMeasures slow{.mismatch = 0.02, .defects = 1, .duration = 100, .speed = 50, .defect_mismatch = 30};
    RunMeasures even = slow;
    even.defect_mismatch = 6;
    EXPECT_DOUBLE_EQ(objective(slow, even, 1, 0), 0.03 + 0.5 + 0.1 * 0.2 + 1);
    EXPECT_EQ(why_not_better(slow, even, 0), "");
    EXPECT_EQ(why_not_better(even, slow, 0),
              "the speeds of adjacent passes would differ by 1800 instead of 360 mm/min");
    RunMeasures uneven = slow, better = even;  // more than 0.2 % of 50 mm/s: the percentile counts
    uneven.mismatch = better.mismatch = 0.2;
    EXPECT_DOUBLE_EQ(objective(uneven, better, 1, 0), 0.03 + 1 + 0.05 + 1);
}

// The remaining share of the roughness is added; if it is not known it does not count.
TEST(Objective, RoughnessCountsWhereItIsKnown) {
    RunMeasures rough = before, smoother = before;
    rough.roughness = 0.002;
    smoother.roughness = 0.0015;
    EXPECT_DOUBLE_EQ(objective(rough, smoother, 1, 0), 0.03 + 1.05 + 1 + 0.75);
    EXPECT_DOUBLE_EQ(objective(rough, before, 1, 0), 0.03 + 1.05 + 1);
    RunMeasures better{9, 20, 100};
    better.roughness = 0.002 * 1.009;
    EXPECT_EQ(why_not_better(rough, better, 0), "") << "within what the measurement can tell";
    better.roughness = 0.002 * 1.011;
    EXPECT_NE(why_not_better(rough, better, 0).find("rougher: Ra 2.02 instead of 2.00"), std::string::npos);
    EXPECT_EQ(why_not_better(before, better, 0), "") << "not known before";
}

EnsembleResult ensemble(const std::vector<RunMeasures>& after) {
    EnsembleResult result;
    for (const RunMeasures& each : after) result.runs.push_back({before, each, gain_of(before, each, 1, 0)});
    return result;
}

TEST(EnsembleTest, MeanAndWorstAreOfTheRuns) {
    const EnsembleResult runs = ensemble({{4, 10, 99}, {8, 14, 97}});
    EXPECT_DOUBLE_EQ(runs.mean().after.mismatch, 6);
    EXPECT_DOUBLE_EQ(runs.mean().after.defects, 12);
    EXPECT_DOUBLE_EQ(runs.mean().after.duration, 98);
    EXPECT_DOUBLE_EQ(runs.worst().after.mismatch, 8);
}

TEST(EnsembleTest, TheMeanMustBeBetterAndNoMachineWorse) {
    EXPECT_EQ(why_not_better(EnsembleResult{}, 0), "");
    EXPECT_EQ(why_not_better(ensemble({{4, 10, 99}, {6, 12, 99}}), 0), "");
    EXPECT_NE(why_not_better(ensemble({{4, 10, 99}, {9, 31, 99}}), 0), "") << "20.5 defects on the mean";
    EXPECT_NE(why_not_better(ensemble({{4, 4, 99}, {9, 31, 99}}), 0).find("on one of 2"), std::string::npos);
    EXPECT_NE(why_not_better(ensemble({{9.9, 20, 99}, {9.9, 20, 99}}), 0).find("less than 2 %"), std::string::npos);
    EXPECT_EQ(why_not_better(ensemble({{4, 10, 98}, {4, 10, 100.4}}), 0), "") << "0.4 % longer on one machine";
    EXPECT_NE(why_not_better(ensemble({{4, 10, 98}, {4, 10, 100.6}}), 0), "");
}

}  // namespace
}  // namespace clsurf::objective_test

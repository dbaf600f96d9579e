#include "field/range.h"

#include <gtest/gtest.h>

#include "field/pass_ramps.h"

namespace clsurf::range_test {
namespace {

/// 10,000 points of value 100 on one pass of 1 ms periods.
class RangeTest : public ::testing::Test {
protected:
    RangeTest() {
        field_.values.resize(10'000);
        for (float& value : field_.values) value = 100;
        surface_.passes.push_back({0, 9999, PassKind::cut});
        surface_.neighbours.left.resize(10'000);
        surface_.neighbours.right.resize(10'000);
        for (std::size_t i = 0; i < 10'000; ++i)
            surface_.neighbours.left[i] = surface_.neighbours.right[i] = Adjacency::none;
    }
    void set(PointIndex first, PointIndex count, float value) {
        for (PointIndex i = first; i < first + count; ++i) field_.values[static_cast<std::size_t>(i)] = value;
    }

    Field field_;
    ClSurface surface_;
};

TEST_F(RangeTest, CutsOffSinglePointsButNoPatch) {
    set(1000, 19, 500);
    EXPECT_NEAR(find_range(field_, surface_, {}).high, 100, 1);
    set(3000, 20, 300);
    EXPECT_NEAR(find_range(field_, surface_, {}).high, 300, 3);
    set(5000, 20, 20);
    EXPECT_NEAR(find_range(field_, surface_, {}).low, 20, 3);
}

TEST_F(RangeTest, APatchReachesOverAdjacentPasses) {
    set(1000, 10, 500);
    set(4000, 10, 400);
    EXPECT_EQ(find_range(field_, surface_, {}).high, 100);
    for (std::size_t i = 1000; i < 1010; ++i) surface_.neighbours.left[i] = 3000;
    EXPECT_NEAR(find_range(field_, surface_, {}).high, 400, 4) << "20 points together, the weakest has 400";
    EXPECT_EQ(find_range(field_, surface_.passes, {}).high, 100) << "adjacent passes are not known";
}

TEST_F(RangeTest, ASectionBeyondTheThresholdIsShownWhole) {
    field_.info.threshold = 200;
    set(1000, 2, 900);
    EXPECT_EQ(find_range(field_, surface_, {}).high, 100) << "two points are a spike";
    set(1500, 2, 900);
    surface_.neighbours.left[1001] = 499;
    EXPECT_GE(find_range(field_, surface_, {}).high, 900) << "the adjacent pass has it as well";
    set(1000, 1000, 100);
    set(3000, 3, 300);
    set(3001, 1, 700);
    EXPECT_GE(find_range(field_, surface_, {}).high, 700);
    field_.info.threshold = 400;
    EXPECT_EQ(find_range(field_, surface_, {}).high, 100) << "one point alone exceeds the threshold";
    set(3000, 3, -500);
    EXPECT_LE(find_range(field_, surface_, {}).low, -500);
}

TEST_F(RangeTest, DefectsAreShownWhole) {
    set(1000, 2, 500);
    set(3000, 1, -50);
    const std::vector<PointRange> defects{{998, 1001}, {2999, 3000}};
    const auto is_shown = [](PointIndex i) { return i < 2000; };
    EXPECT_GE(find_range(field_, surface_, {}, {}, defects).high, 500);
    EXPECT_LE(find_range(field_, surface_, {}, {}, defects).low, -50);
    EXPECT_EQ(find_range(field_, surface_, {}, is_shown, defects).low, 100) << "outside the picture";
    surface_.passes = Passes();
    for (const Pass& pass : {Pass{0, 999}, Pass{1000, 1001, PassKind::link}, Pass{1002, 9999}})
        surface_.passes.push_back(pass);
    EXPECT_LT(find_range(field_, surface_, {}, {}, defects).high, 110) << "left out of the selection";
}

TEST_F(RangeTest, EndsAndEdgesAreRound) {
    set(1000, 200, 2137.3F);
    set(4000, 200, 384.7F);
    const ShownRange range = find_range(field_, surface_, {});
    EXPECT_EQ(range.low, 100);
    EXPECT_EQ(range.high, 2150);
    set(1000, 200, 1013.3F);
    EXPECT_EQ(find_range(field_, surface_, {}).high, 1020) << "three digits";
    set(1000, 200, 2137.3F);
    RangeRule six;
    six.bins = 6;
    const ShownRange stepped = find_range(field_, surface_, six);
    EXPECT_EQ(stepped.low, 0);
    EXPECT_EQ(stepped.high, 2400) << "steps of 400";
}

TEST_F(RangeTest, PercentilesAreAsGiven) {
    set(1000, 20, 500);
    EXPECT_EQ(find_range(field_, surface_, {RangeRule::Kind::percentiles, 1, 99}).high, 100);
}

TEST_F(RangeTest, SpansWhatMatters) {
    field_.info.least_span_of_median = 0.1;
    field_.info.preference = FieldPreference::higher;
    const ShownRange fast = find_range(field_, surface_, {});
    EXPECT_NEAR(fast.low, 90, 1e-9);
    EXPECT_NEAR(fast.high, 100, 1e-9);
    field_.info.preference = FieldPreference::lower;
    EXPECT_NEAR(find_range(field_, surface_, {}).high, 110, 1e-9);
    field_.info.least_span = 50;
    EXPECT_NEAR(find_range(field_, surface_, {}).high, 150, 1e-9);
}

TEST_F(RangeTest, SignedValuesSpanBothSides) {
    field_.info.scale = FieldScale::diverging;
    field_.info.least_span = 8;
    set(0, 10'000, 1);
    const ShownRange range = find_range(field_, surface_, {});
    EXPECT_NEAR(range.low, -4, 1e-9);
    EXPECT_NEAR(range.high, 4, 1e-9);
}

TEST_F(RangeTest, AUsualRangeIsTheSameForAllRuns) {
    field_.info.unit = unit::percent;
    field_.info.usual_range = ValueRange{0, 1};
    EXPECT_EQ(find_range(field_, surface_, {}).high, 100);
    EXPECT_EQ(find_range(field_, surface_, {}).low, 0);
    EXPECT_EQ(find_range(field_, surface_, {RangeRule::Kind::fixed, 20, 30}).low, 20);
}

TEST_F(RangeTest, RampsOfPassesEndWhereTheSpeedDoes) {
    // 100 points from 1 to 100 at the beginning; at the end first a fall of 20 points, as at a step to the next pass.
    for (PointIndex i = 0; i < 100; ++i) set(i, 1, static_cast<float>(i + 1));
    for (PointIndex i = 0; i < 60; ++i) set(9979 - i, 1, static_cast<float>(20 + i));
    for (PointIndex i = 0; i < 20; ++i) set(9980 + i, 1, static_cast<float>(20 + i));
    const std::vector<PointRange> ramps = pass_ramps(field_, surface_.passes, 0.001);
    ASSERT_EQ(ramps.size(), 2u);
    EXPECT_EQ(ramps[0].first, 0);
    EXPECT_NEAR(static_cast<double>(ramps[0].last), 97, 6);
    EXPECT_EQ(ramps[1].last, 9999);
    EXPECT_NEAR(static_cast<double>(ramps[1].first), 9922, 8);
}

TEST_F(RangeTest, APassAtFullSpeedHasNoRamp) {
    set(400, 300, 20);
    EXPECT_TRUE(pass_ramps(field_, surface_.passes, 0.001).empty());
}

}  // namespace
}  // namespace clsurf::range_test

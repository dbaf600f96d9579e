#include "core/point_ranges.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::point_ranges_test {
namespace {

const std::vector<PointRange> ranges{{10, 19}, {20, 20}, {30, 39}};
const std::vector<PointRange> none;

TEST(PointRanges, APointOfARangeFindsIt) {
    EXPECT_EQ(range_at(ranges, 10)->first, 10);
    EXPECT_EQ(range_at(ranges, 19)->first, 10);
    EXPECT_EQ(range_at(ranges, 20)->first, 20);
    EXPECT_EQ(range_at(ranges, 39)->first, 30);
}

TEST(PointRanges, APointOfNoRangeFindsTheOneBeforeIt) {
    EXPECT_EQ(range_at(ranges, 25)->first, 20);
    EXPECT_EQ(range_at(ranges, 100)->first, 30);
    EXPECT_EQ(range_at(ranges, 3)->first, 10) << "there is none before it";
    EXPECT_EQ(range_at(none, 3), none.end());
}

TEST(PointRanges, TheLastPointIsOneOfTheRange) {
    for (const PointIndex point : {10, 15, 19, 20, 30, 39}) EXPECT_TRUE(any_has(ranges, point)) << point;
    for (const PointIndex point : {0, 9, 21, 29, 40}) EXPECT_FALSE(any_has(ranges, point)) << point;
    EXPECT_FALSE(any_has(none, 0));
}

}  // namespace
}  // namespace clsurf::point_ranges_test

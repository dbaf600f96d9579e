#include "core/statistics.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::statistics_test {
namespace {

TEST(Statistics, OfAnEvenNumberTheMidpointMedianIsTheMeanOfBothAndTheMedianTheUpper) {
    std::vector<double> even{10, 1, 3, 2}, odd{5, 9, 1};
    EXPECT_EQ(midpoint_median(even), 2.5);
    EXPECT_EQ(median(even), 3);
    EXPECT_EQ(midpoint_median(odd), 5);
    EXPECT_EQ(median(odd), 5);
}

TEST(Statistics, MidpointMedianTakesPartsAndTemporaries) {
    std::vector<float> values{4, 2, 100};
    EXPECT_EQ(midpoint_median(std::span(values).first(2)), 3.0F);
    EXPECT_EQ(midpoint_median(std::vector{7.0}), 7);
}

}  // namespace
}  // namespace clsurf::statistics_test

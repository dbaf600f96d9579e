#include "viz/colour_difference.h"

#include <gtest/gtest.h>

namespace clsurf::viz::colour_difference_test {
namespace {

struct Pair {
    Lab a, b;
    double difference;
};

// Published test data: Sharma, Wu, Dalal 2005, "The CIEDE2000 color-difference formula".
constexpr Pair pairs[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(ColourDifference, IsThatOfThePublishedPairs) {
    for (const Pair& pair : pairs) {
        EXPECT_NEAR(delta_e00(pair.a, pair.b), pair.difference, 1e-4);
        EXPECT_NEAR(delta_e00(pair.b, pair.a), pair.difference, 1e-4);
        EXPECT_EQ(delta_e00(pair.a, pair.a), 0);
    }
}

TEST(ColourDifference, WhiteAndBlackAreTheEndsOfTheScale) {
    EXPECT_NEAR(lab_of(Rgb{255, 255, 255})[0], 100, 1e-3);
    EXPECT_NEAR(lab_of(Rgb{0, 0, 0})[0], 0, 1e-9);
    EXPECT_NEAR(delta_e00(lab_of(Rgb{255, 255, 255}), lab_of(Rgb{0, 0, 0})), 100, 1e-3);
}

}  // namespace
}  // namespace clsurf::viz::colour_difference_test

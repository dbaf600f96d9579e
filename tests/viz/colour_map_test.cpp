#include "viz/colour_map.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clsurf::viz {
namespace {

double lightness(Rgb c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(ColourMap, IsurfaceHasTheColoursOfThePaper) {
    const ColourMap map = make_colour_map("isurface");
    EXPECT_EQ(map.at(0), (Rgb{0, 0, 255}));
    EXPECT_EQ(map.at(0.25), (Rgb{0, 255, 255}));
    EXPECT_EQ(map.at(0.5), (Rgb{0, 255, 0}));
    EXPECT_EQ(map.at(0.625), (Rgb{128, 255, 0}));
    EXPECT_EQ(map.at(1), (Rgb{255, 0, 0}));
    EXPECT_EQ(map.at(-3), map.at(0));
}

TEST(ColourMap, EvenMapsRiseInLightness) {
    for (const char* name : {"viridis", "cividis", "gray"}) {
        const ColourMap map = make_colour_map(name);
        for (int k = 1; k <= 100; ++k) EXPECT_GT(lightness(map.at(k / 100.0)) + 0.6, lightness(map.at((k - 1) / 100.0))) << name << k;
    }
}

TEST(ColourMap, TakesOwnStopsAndNamesWrongOnes) {
    EXPECT_EQ(make_colour_map("#000000,ff0000").at(0.5), (Rgb{128, 0, 0}));
    EXPECT_THROW((void)make_colour_map("viridos"), UsageError);
    EXPECT_THROW((void)make_colour_map("#000000,red"), UsageError);
}

TEST(ColourScale, ShowsMissingAndEqualValues) {
    ColourScale scale{make_colour_map("isurface"), 5, 5, 0};
    EXPECT_EQ(scale.colour(5), (Rgb{0, 255, 0}));
    EXPECT_EQ(scale.colour(std::numeric_limits<double>::quiet_NaN()), missing_colour);
}

TEST(ColourScale, StepsInBins) {
    const ColourScale scale{make_colour_map("gray"), 0, 10, 2};
    EXPECT_EQ(scale.colour(0), scale.colour(4.9));
    EXPECT_NE(scale.colour(4.9), scale.colour(5.1));
}

TEST(Ticks, AreRound) {
    EXPECT_EQ(nice_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(nice_ticks(-0.3, 0.3, 3), (std::vector<double>{-0.2, 0, 0.2}));
    EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
    EXPECT_EQ(tick_text(1500, 500), "1500");
}

}  // namespace
}  // namespace clsurf::viz

#include "viz/colour_map.h"

#include <algorithm>

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
        for (int k = 1; k <= 100; ++k)
            EXPECT_GT(lightness(map.at(k / 100.0)) + 0.6, lightness(map.at((k - 1) / 100.0))) << name << k;
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

TEST(ColourScale, RampHasTheColourOfEachValueAtItsPlace) {
    for (const int bins : {0, 7}) {
        const ColourScale scale{make_colour_map("viridis"), -2, 6, bins};
        const std::vector<Rgb> ramp = scale.ramp();
        for (double value = -3; value <= 7; value += 0.37) {
            const double texel = std::clamp(scale.along(value), 0.0, 1.0) * static_cast<double>(ramp.size());
            const Rgb at = ramp[std::min(ramp.size() - 1, static_cast<std::size_t>(texel))];
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(at[k], scale.colour(value)[k], bins > 0 ? 0 : 2) << value << ' ' << bins;
        }
    }
}

TEST(ColourScale, CentredMapsHaveTheirMiddleAtZero) {
    const ColourScale even{make_colour_map("coolwarm"), -4, 4, 0};
    const ColourScale uneven{make_colour_map("coolwarm"), -1, 4, 0};
    EXPECT_EQ(uneven.colour(0), even.colour(0));
    EXPECT_EQ(uneven.colour(-1), even.colour(-1));
    EXPECT_EQ(uneven.colour(4), even.colour(4));
    // Where 0 is not in the range there is no middle to keep.
    const ColourScale above{make_colour_map("coolwarm"), 1, 4, 0};
    EXPECT_EQ(above.colour(1), make_colour_map("coolwarm").at(0));
}

TEST(Ticks, AreRound) {
    EXPECT_EQ(nice_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(nice_ticks(-0.3, 0.3, 3), (std::vector<double>{-0.2, 0, 0.2}));
    EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
    EXPECT_EQ(tick_text(1500, 500), "1500");
    EXPECT_EQ(tick_text(-0.3, 10), "0");
}

}  // namespace
}  // namespace clsurf::viz

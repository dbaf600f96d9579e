#include "viz/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/error.h"
#include "viz/colour_difference.h"

namespace clsurf::viz::colour_map_test {
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
    for (const char* name : {"magma", "viridis", "cividis", "gray"}) {
        const ColourMap map = make_colour_map(name);
        for (int k = 1; k <= 100; ++k)
            EXPECT_GT(lightness(map.at(k / 100.0)) + 0.6, lightness(map.at((k - 1) / 100.0))) << name << k;
    }
}

TEST(ColourMap, TakesOwnStopsAndNamesWrongOnes) {
    EXPECT_EQ(make_colour_map("#000000,ff0000").at(0.5), (Rgb{128, 0, 0}));
    EXPECT_THROW((void)make_colour_map("viridos"), UsageError);
    EXPECT_THROW((void)make_colour_map("viridos_r"), UsageError);
    EXPECT_THROW((void)make_colour_map("#000000,red"), UsageError);
}

TEST(ColourMap, IsReversedBySuffix) {
    const ColourMap map = make_colour_map("magma");
    const ColourMap reversed = make_colour_map("magma_r");
    EXPECT_EQ(reversed.name(), "magma_r");
    for (int k = 0; k <= 20; ++k) EXPECT_EQ(map.at(k / 20.0), reversed.at(1 - k / 20.0)) << k;
}

TEST(ColourMap, PartsSpanTheWholeRange) {
    const ColourMap map = make_colour_map("viridis");
    const ColourMap part = map.part(0.2, 0.7);
    for (int k = 0; k <= 10; ++k) {
        const Rgb expected = map.at(0.2 + 0.05 * k);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(part.at(k / 10.0)[c], expected[c], 1) << k;
    }
}

/// A colour as seen without green cones (Viénot, Brettel, Mollon 1999), in sRGB.
Rgb as_deuteranope(Rgb c) {
    std::array<double, 3> linear{};
    for (std::size_t k = 0; k < 3; ++k) linear[k] = std::pow(c[k] / 255.0, 2.2);
    const std::array<double, 3> seen{0.29275 * linear[0] + 0.70725 * linear[1],
                                     0.29275 * linear[0] + 0.70725 * linear[1],
                                     -0.02234 * linear[0] + 0.02234 * linear[1] + linear[2]};
    Rgb result{};
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = static_cast<std::uint8_t>(255 * std::pow(std::clamp(seen[k], 0.0, 1.0), 1 / 2.2));
    return result;
}

TEST(ColourMap, MapOfSpeedsIsEvenAlsoForTheColourBlind) {
    const ColourMap map = make_colour_map("magma");
    // Equal steps appear equally different: CIEDE2000 per twentieth stays within a factor of its mean.
    std::vector<double> steps;
    std::vector<double> seen;
    for (int k = 1; k <= 20; ++k) {
        const Rgb a = map.at((k - 1) / 20.0);
        const Rgb b = map.at(k / 20.0);
        steps.push_back(delta_e00(lab_of(a), lab_of(b)));
        seen.push_back(delta_e00(lab_of(as_deuteranope(a)), lab_of(as_deuteranope(b))));
    }
    for (const std::vector<double>* of : {&steps, &seen}) {
        const double mean = std::accumulate(of->begin(), of->end(), 0.0) / 20;
        for (const double step : *of) {
            EXPECT_GT(step, 0.35 * mean);
            EXPECT_LT(step, 2.2 * mean);
        }
    }
}

TEST(ColourScale, HasAColourOfItsOwnBeyondTheRange) {
    for (const char* name : {"magma", "magma_r", "coolwarm", "viridis", "gray"}) {
        const ColourScale scale{make_colour_map(name), 0, 100, 0, 5};
        EXPECT_EQ(scale.colour(104), scale.colour(100)) << "within the slack";
        EXPECT_EQ(scale.along(104), scale.along(100));
        for (int k = 0; k <= 100; ++k) {
            EXPECT_GT(delta_e00(lab_of(scale.colour(120)), lab_of(scale.colour(k))), 12) << name << k;
            EXPECT_GT(delta_e00(lab_of(scale.colour(-20)), lab_of(scale.colour(k))), 12) << name << k;
        }
    }
    const ColourScale paper{make_colour_map("isurface"), 0, 100, 0};
    EXPECT_EQ(paper.colour(120), paper.colour(100));
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
    // If 0 is not in the range there is no middle to keep.
    const ColourScale above{make_colour_map("coolwarm"), 1, 4, 0};
    EXPECT_EQ(above.colour(1), make_colour_map("coolwarm").at(0));
}

TEST(Ticks, AreRound) {
    EXPECT_EQ(nice_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(nice_ticks(-0.3, 0.3, 3), (std::vector<double>{-0.2, 0, 0.2}));
    EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
    EXPECT_EQ(tick_text(1500, 500), "1500");
    EXPECT_EQ(tick_text(-0.3, 10), "0");
    EXPECT_EQ(tick_text(-300, 100), "−300");
    EXPECT_EQ(tick_text(-0.25, 0.05), "−0.25");
    EXPECT_EQ(tick_text(-2e6, 1e6), "−2e+06");
}

}  // namespace
}  // namespace clsurf::viz::colour_map_test

#include "machined/roughness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "machined/scallop.h"
#include "support/scallop_roughness.h"

namespace clsurf::roughness_test {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> sine(double amplitude, double wave, double length, double step) {
    std::vector<double> z;
    for (double x = 0; x < length; x += step) z.push_back(amplitude * std::sin(2 * pi * x / wave));
    return z;
}

TEST(Roughness, OfASineIsTwoOverPiOfItsAmplitude) {
    const Roughness r = roughness_of(sine(0.001, 0.08, 6, 0.001), 0.001, 0.8);
    EXPECT_EQ(r.sampling_lengths, 5);
    EXPECT_DOUBLE_EQ(r.length, 4.0);
    EXPECT_NEAR(r.ra, 0.001 * 2 / pi, 1e-6);  // 80 values per wave
    EXPECT_NEAR(r.rq, 0.001 / std::sqrt(2.0), 1e-7);
    EXPECT_NEAR(r.rz, 0.002, 1e-6);
}

TEST(Roughness, TheFilterHalvesAWaveOfItsCutoff) {
    // 1 − e^(−π (α λc/λ)²), α² = ln 2/π: ½ at λc, 15.9 % of a wave twice as long, 94 % of half of one.
    const auto passed = [](double wave) {
        return roughness_of(sine(0.001, wave, 24, 0.002), 0.002, 0.8).rq * std::sqrt(2.0) / 0.001;
    };
    EXPECT_NEAR(passed(0.8), 0.5, 0.005);
    EXPECT_NEAR(passed(1.6), 1 - std::pow(0.5, 0.25), 0.005);
    EXPECT_NEAR(passed(0.4), 1 - std::pow(0.5, 4), 0.005);
}

TEST(Roughness, IsThatOfDistancesAlongTheProfile) {
    // A sine along a profile of increasing slope, in equal steps in plan view.
    std::vector<double> z;
    std::vector<double> along;
    for (double x = 0; x < 6; x += 0.001) {
        along.push_back(x + 0.05 * x * x);  // the arc length increases by 1 … 1.6 per millimetre of x
        z.push_back(0.001 * std::sin(2 * pi * along.back() / 0.8));
    }
    const Roughness r = roughness_of(z, along, 0.8);
    EXPECT_EQ(r.sampling_lengths, 5);
    EXPECT_NEAR(r.length, 4, 0.004);
    EXPECT_NEAR(r.rq, 0.5 * 0.001 / std::sqrt(2.0), 0.005 * 0.001);
    const std::vector<double> line = gaussian_mean_line(z, along, 0.8);
    for (std::size_t k = 2000; k < 4000; ++k) EXPECT_NEAR(line[k], 0.5 * z[k], 2e-6);
    EXPECT_EQ(roughness_of(std::vector<double>{1.0}, std::vector<double>{0.0}, 0.8).length, 0);
}

TEST(Roughness, TheMeanLineOfAConstantIsItself) {
    for (const double v : gaussian_mean_line(std::vector<double>(500, 0.7), 0.01, 0.8)) EXPECT_NEAR(v, 0.7, 1e-12);
}

TEST(Roughness, ParabolasHaveTheRoughnessOfTheBooks) {
    constexpr double height = 0.004;
    std::vector<double> z;
    for (int k = 0; k < 40000; ++k) {
        const double x = std::fmod(k * 0.0001, 0.2) / 0.1 - 1;  // −1 … 1 over one pass
        z.push_back(height * x * x);
    }
    const ProfileHeights h = profile_heights(z);
    EXPECT_NEAR(h.ra, test::scallop_ra(height), 1e-7);
    EXPECT_NEAR(h.rq, test::scallop_rq(height), 1e-7);
    EXPECT_NEAR(h.rz, height, 1e-7);
    const Roughness r = roughness_of(z, 0.0001, 0.8);
    EXPECT_NEAR(r.ra, test::scallop_ra(height), 0.01 * test::scallop_ra(height));
    EXPECT_NEAR(r.rz, height, 0.01 * height);
}

TEST(Roughness, AShortProfileIsOneSamplingLength) {
    const Roughness r = roughness_of(sine(0.001, 0.1, 1.0, 0.001), 0.001, 0.8);
    EXPECT_EQ(r.sampling_lengths, 1);
    EXPECT_NEAR(r.length, 1.0, 0.002);
    EXPECT_EQ(roughness_of(std::vector<double>{1.0}, 0.001, 0.8).length, 0);
}

TEST(Roughness, TheCutoffIsThatOfIso4288) {
    EXPECT_EQ(cutoff_for(0.1), 0.8);
    EXPECT_EQ(cutoff_for(0.4), 0.8);
    EXPECT_EQ(cutoff_for(0.4002), 0.8) << "a programmed step-over of 0.4 mm, estimated from positions";
    EXPECT_EQ(cutoff_for(0.41), 2.5);
    EXPECT_EQ(cutoff_for(0.5), 2.5);
    EXPECT_EQ(cutoff_for(1.302), 2.5);
    EXPECT_EQ(cutoff_for(2), 8);
}

TEST(Roughness, AnAreaIsMeasuredAboutItsMean) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const AreaHeights h = area_heights(std::vector<float>{2, 4, none, 6, 8});
    EXPECT_EQ(h.cells, 4U);
    EXPECT_DOUBLE_EQ(h.sa, 2);
    EXPECT_DOUBLE_EQ(h.sq, std::sqrt(5.0));
    EXPECT_DOUBLE_EQ(h.sz, 6);
    EXPECT_EQ(area_heights(std::vector<float>{none}).cells, 0U);
}

TEST(Roughness, AnAreasHeightsAreWeighed) {
    const std::vector<float> z{2, 6, 100, -1};
    const AreaHeights h = area_heights(z, std::vector<float>{1, 0.75F, 0, 0.25F});
    const double mean = (2 + 4.5 - 0.25) / 2;
    EXPECT_NEAR(h.sa, ((mean - 2) + 0.75 * (6 - mean) + 0.25 * (mean + 1)) / 2, 1e-12);
    EXPECT_NEAR(h.sq, std::sqrt((4 + 27 + 0.25) / 2 - mean * mean), 1e-12);
    EXPECT_DOUBLE_EQ(h.sz, 4) << "of values that weigh a half at least";
    EXPECT_EQ(area_heights(z, std::vector<float>(4, 0)).cells, 0U);
}

}  // namespace
}  // namespace clsurf::roughness_test

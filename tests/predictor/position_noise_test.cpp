// The scatter of positions along the feed, for errors of a known size.
#include "predictor/position_noise.h"

#include <gtest/gtest.h>

#include <random>

#include "support/made_surface.h"

namespace clsurf::position_noise_test {
namespace {

std::vector<PointRange> pieces_of(const test::MadeSurface& made) {
    std::vector<PointRange> pieces;
    for (const Pass& pass : made.surface.passes) pieces.push_back({pass.first, pass.last});
    return pieces;
}

/// Moves each commanded position by an independent error along x, the feed.
void scatter(test::MadeSurface& made, double deviation) {
    std::mt19937_64 generator(7);
    std::normal_distribution<double> error(0, deviation);
    for (std::size_t i = 0; i < static_cast<std::size_t>(made.path.count); ++i) (*made.columns)[i] += error(generator);
}

TEST(PositionNoise, IsTheDeviationOfIndependentErrors) {
    for (const double deviation : {0.0005, 0.005}) {
        test::MadeSurface made = test::flat_zigzag(9, 30, 0.4, 50, {});
        scatter(made, deviation);
        EXPECT_NEAR(position_noise(made.path, pieces_of(made)), deviation, 0.1 * deviation);
    }
}

TEST(PositionNoise, IsNothingOnAnExactPath) {
    const test::MadeSurface made = test::flat_zigzag(9, 30, 0.4, 50, {});
    EXPECT_LT(position_noise(made.path, pieces_of(made)), 1e-9);
}

TEST(PositionNoise, IsNotKnownOfAFewRecords) {
    test::MadeSurface made = test::flat_zigzag(9, 30, 0.4, 50, {});
    scatter(made, 0.005);
    EXPECT_EQ(position_noise(made.path, {{0, 50}}), 0);
}

}  // namespace
}  // namespace clsurf::position_noise_test

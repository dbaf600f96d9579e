#include "core/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/statistics.h"

namespace clsurf::distribution_test {
namespace {

using Floats = std::numeric_limits<float>;

TEST(SumOfSquares, IsExact) {
    SumOfSquares sum;
    EXPECT_EQ(sum.value(), 0);
    sum.add(3);
    sum.add(-4);
    EXPECT_EQ(sum.value(), 25);
    // The square of 2^−149 is one unit of the lowest digit.
    SumOfSquares least;
    least.add(Floats::denorm_min());
    EXPECT_EQ(least.value(), std::ldexp(1.0, -298));
    EXPECT_EQ(least.digits()[0], 1U);
    SumOfSquares most;
    most.add(Floats::max());
    EXPECT_EQ(most.value(), static_cast<double>(Floats::max()) * static_cast<double>(Floats::max()));
    // Doubles lose the ones: 2^60 + 1000 is not a multiple of 256, the spacing of doubles there.
    SumOfSquares wide;
    wide.add(std::ldexp(1.0F, 30));
    for (int k = 0; k < 1000; ++k) wide.add(1);
    SumOfSquares thousand;
    for (int k = 0; k < 1000; ++k) thousand.add(1);
    EXPECT_EQ(wide.digits()[298 / 32] - thousand.digits()[298 / 32], 0U);
    EXPECT_EQ(thousand.value(), 1000);
    EXPECT_EQ(wide.value(), std::ldexp(1.0, 60) + 1000);
}

TEST(SumOfSquares, DoesNotDependOnOrderAndParts) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> powers(-60, 60);
    std::vector<float> values(5000);
    for (float& v : values) v = std::exp2(powers(random));
    SumOfSquares forwards, backwards, joined;
    for (const float v : values) forwards.add(v);
    std::reverse(values.begin(), values.end());
    for (const float v : values) backwards.add(v);
    for (std::size_t k = 0; k < 10; ++k) {
        SumOfSquares part;
        for (std::size_t i = k; i < values.size(); i += 10) part.add(values[i]);
        joined.add(SumOfSquares(part.digits()));
    }
    EXPECT_EQ(forwards.digits(), backwards.digits());
    EXPECT_EQ(forwards.digits(), joined.digits());
}

TEST(Distribution, QuantilesAreWithinTheirBound) {
    std::mt19937 random(2);
    std::lognormal_distribution<float> sizes(3, 4);
    std::vector<float> values(20'001, 0.0F);
    std::generate(values.begin() + 100, values.end(), [&] { return sizes(random); });
    Distribution at_once, joined;
    for (const float v : values) at_once.add(v);
    for (std::size_t k = 0; k < 7; ++k) {
        Distribution part;
        for (std::size_t i = k; i < values.size(); i += 7) part.add(values[i]);
        joined.add(Distribution(part.bins(), part.squares()));
    }
    EXPECT_EQ(joined.count(), values.size());
    EXPECT_EQ(joined.bins(), at_once.bins());
    EXPECT_EQ(joined.rms(), at_once.rms());
    double squares = 0;
    for (const float v : values) squares += static_cast<double>(v) * static_cast<double>(v);
    EXPECT_NEAR(joined.rms(), std::sqrt(squares / 20'001), 1e-12 * joined.rms());
    for (const double share : {0.0, 0.001, 0.01, 0.3, 0.5, 0.95, 0.9999, 1.0}) {
        const double exact = quantile_below(values, share);
        EXPECT_NEAR(joined.quantile_below(share), exact, exact * Distribution::quantile_error + 1e-40) << share;
    }
}

TEST(Distribution, HoldsWhateverAFloatCanBe) {
    Distribution sizes;
    EXPECT_TRUE(std::isnan(sizes.quantile_below(0.5)));
    EXPECT_TRUE(std::isnan(sizes.rms()));
    sizes.add(Floats::max());
    EXPECT_NEAR(sizes.quantile_below(0.5), Floats::max(), Floats::max() * Distribution::quantile_error);
    EXPECT_LT(sizes.bins().front().number, Distribution::bin_count);
    EXPECT_EQ(sizes.rms(), Floats::max());
}

}  // namespace
}  // namespace clsurf::distribution_test

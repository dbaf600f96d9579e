#include "numeric/derivative.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

namespace clsurf::derivative_test {
namespace {

constexpr double period = 0.001;

std::vector<double> derive(const std::vector<double>& samples, int derivative) {
    const Differentiator d(derivative_filter(derivative, period));
    std::vector<double> out(samples.size());
    d.apply(samples, 0, {0, static_cast<PointIndex>(samples.size()) - 1}, 0, out);
    return out;
}

TEST(Derivative, OfAStepIsAtMostTheStepResponse) {
    std::vector<double> step(200, 0.0);
    for (std::size_t i = 100; i < step.size(); ++i) step[i] = 0.001;
    for (const int derivative : {1, 2, 3}) {
        const std::vector<double> d = derive(step, derivative);
        double most = 0;
        for (const double value : d) most = std::max(most, std::abs(value));
        const double response = derivative_filter(derivative, period).step_response();
        EXPECT_NEAR(most, 0.001 * response, 1e-9 * response);
    }
}

TEST(Derivative, OfAChangeOfSpeedIsAtMostTheSpeedStepResponse) {
    // From rest to 1 mm/s in one step: a speed of at most 1 mm/s. A parabola over the time T has 1.875 / T of acceleration.
    std::vector<double> ramp(200, 0.0);
    for (std::size_t i = 100; i < ramp.size(); ++i) ramp[i] = static_cast<double>(i - 100) * period;
    for (const int derivative : {1, 2}) {
        const std::vector<double> d = derive(ramp, derivative);
        const DerivativeFilter filter = derivative_filter(derivative, period);
        EXPECT_NEAR(*std::max_element(d.begin(), d.end()), filter.speed_step_response(), 1e-6);
        const double window = filter.points * period;
        EXPECT_NEAR(filter.speed_step_response(), derivative == 1 ? 1 : 1.875 / window, derivative == 1 ? 0.1 : 2);
    }
}

TEST(Derivative, IsExactOnPolynomialsOfItsOrderUpToTheEnds) {
    // x = 3 − 2t + 5t² + 7t³ t: the first two filters are exact to order 2, the third to order 3.
    std::vector<double> square(200);
    std::vector<double> cube(200);
    for (int i = 0; i < 200; ++i) {
        const double t = i * period;
        square[static_cast<std::size_t>(i)] = 3 - 2 * t + 5 * t * t;
        cube[static_cast<std::size_t>(i)] = square[static_cast<std::size_t>(i)] + 7 * t * t * t;
    }
    const std::vector<double> v = derive(square, 1);
    const std::vector<double> a = derive(square, 2);
    const std::vector<double> j = derive(cube, 3);
    for (int i = 0; i < 200; ++i) {
        const double t = i * period;
        EXPECT_NEAR(v[static_cast<std::size_t>(i)], -2 + 10 * t, 1e-8) << i;
        EXPECT_NEAR(a[static_cast<std::size_t>(i)], 10, 1e-5) << i;
        EXPECT_NEAR(j[static_cast<std::size_t>(i)], 42, 2e-1) << i;
    }
}

TEST(Derivative, HasTheNoiseOfTheFormula) {
    // Steps q: σ = q/√12. Speed (σ/T)·√(12/(n(n²−1))), acceleration (2σ/T²)·√(180/(n(n²−1)(n²−4))).
    std::mt19937_64 random(3);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::vector<double> samples(200'000);
    for (double& s : samples) s = noise(random);
    const double n = derivative_filter(1, period).points;
    ASSERT_EQ(n, 21);
    const auto rms = [](const std::vector<double>& values) {
        double sum = 0;
        for (std::size_t i = 100; i + 100 < values.size(); ++i) sum += values[i] * values[i];
        return std::sqrt(sum / static_cast<double>(values.size() - 200));
    };
    EXPECT_NEAR(rms(derive(samples, 1)) / (std::sqrt(12 / (n * (n * n - 1))) / period), 1.0, 0.02);
    EXPECT_NEAR(rms(derive(samples, 2)) / (2 * std::sqrt(180 / (n * (n * n - 1) * (n * n - 4))) / (period * period)),
                1.0, 0.02);
}

TEST(Derivative, HasNoLag) {
    // The derivative of a slow sine peaks where the cosine does.
    std::vector<double> samples(2000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = std::sin(2 * M_PI * 2.0 * static_cast<double>(i) * period);
    const std::vector<double> v = derive(samples, 1);
    std::size_t peak = 300;
    for (std::size_t i = 300; i < 700; ++i) {
        if (v[i] > v[peak]) peak = i;
    }
    EXPECT_EQ(peak, 500u);
}

TEST(Derivative, FitsShortPiecesWholeAndGivesNothingForTooFewPoints) {
    const std::vector<double> four{0, 1e-3, 4e-3, 9e-3};  // (i T)² · 1000
    const std::vector<double> v = derive(four, 1);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(v[static_cast<std::size_t>(i)], 2.0 * i, 1e-9);
    EXPECT_TRUE(std::isnan(derive({1.0, 2.0}, 1)[0]));
}

TEST(Derivative, StatesItsBandwidth) {
    // A sine of that frequency is attenuated to 1/√2.
    const DerivativeFilter filter = derivative_filter(1, period);
    const double f = filter.bandwidth();
    std::vector<double> samples(4000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = std::sin(2 * M_PI * f * static_cast<double>(i) * period);
    double most = 0;
    const std::vector<double> v = derive(samples, 1);
    for (std::size_t i = 100; i < 3900; ++i) most = std::max(most, std::abs(v[i]));
    EXPECT_NEAR(most / (2 * M_PI * f), std::sqrt(0.5), 0.01);
}

/// A line of savgol_reference.csv, written with SciPy.
struct Reference {
    int window = 0, order = 0, derivative = 0;
    std::vector<double> values;
};

std::vector<Reference> read_references() {
    std::ifstream file(TEST_SOURCES "/numeric/savgol_reference.csv");
    std::vector<Reference> references;
    for (std::string line; std::getline(file, line);) {
        std::istringstream fields(line);
        Reference reference;
        char comma = 0;
        fields >> reference.window >> comma >> reference.order >> comma >> reference.derivative;
        for (double value = 0; fields >> comma >> value;) reference.values.push_back(value);
        references.push_back(std::move(reference));
    }
    return references;
}

TEST(Derivative, IsThatOfSciPyToItsEnds) {
    const std::vector<Reference> references = read_references();
    ASSERT_EQ(references.size(), 8u);
    const std::vector<double>& signal = references.front().values;
    ASSERT_EQ(signal.size(), 160u);
    for (std::size_t k = 1; k < references.size(); ++k) {
        const Reference& r = references[k];
        const Differentiator d({r.window, r.order, r.derivative, 0.25});
        std::vector<double> values(signal.size());
        d.apply(signal, 0, {0, 159}, 0, values);
        ASSERT_EQ(r.values.size(), values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            EXPECT_NEAR(values[i], r.values[i], 1e-9) << "window " << r.window << ", order " << r.order
                                                      << ", derivative " << r.derivative << ", sample " << i;
        }
    }
}

}  // namespace
}  // namespace clsurf::derivative_test

// Fits of windows compared with NumPy and with values computed independently for another room; exact polynomials.

#include "scan/windowed_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "support/vector_rows.h"

namespace clsurf::windowed_fit_test {
namespace {

std::map<std::string, std::vector<double>> numbers_of(const std::string& room, const std::string& file) {
    std::map<std::string, std::vector<double>> numbers;
    for (VectorRow& row : vector_rows(room, file)) {
        for (std::string word = row.word(); !word.empty(); word = row.word())
            numbers[row.name].push_back(std::stod(word));
    }
    return numbers;
}

void expect_fit(const FitRules& rules, const std::string& name) {
    auto numbers = numbers_of("scan", "joined_fits.txt");
    const WindowedFit fit = fit_windows(numbers["x"], numbers["z"], rules);
    const std::vector<double>& expected = numbers[fmt::format("{}_{}_{}", name, rules.degree, rules.window)];
    ASSERT_EQ(expected.size(), 41U);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(fit.at(numbers["places"][i]), expected[i], 1e-9)
            << name << " " << rules.degree << " at " << numbers["places"][i];
}

TEST(WindowedFit, ContinuousFitsAreThoseOfNumPy) {
    for (const auto& [degree, window] : {std::pair(2, 8), {3, 10}, {5, 16}, {9, 27}})
        expect_fit({degree, static_cast<std::size_t>(window), WindowJoin::c1}, "c1");
}

TEST(WindowedFit, BlendedFitsAreThoseOfNumPy) {
    for (const auto& [degree, window] : {std::pair(1, 6), {3, 10}, {5, 13}})
        expect_fit({degree, static_cast<std::size_t>(window), WindowJoin::blend}, "blend");
}

TEST(WindowedFit, WindowsApartJumpAsComputedIndependently) {
    auto numbers = numbers_of("numeric", "windowed_fit.txt");
    const std::vector<double>& z = numbers["heights"];
    std::vector<double> x;
    for (std::size_t i = 0; i < z.size(); ++i) x.push_back(10.0 * static_cast<double>(i));
    const WindowedFit fit = fit_windows(x, z, {3, 10, WindowJoin::none});
    ASSERT_EQ(fit.pieces.size(), 22U);
    const std::vector<PieceStep> steps = fit.steps();
    ASSERT_EQ(steps.size(), 21U);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        EXPECT_NEAR(steps[k].z, numbers["value_jumps"][k], 1e-9);
        EXPECT_NEAR(steps[k].slope, numbers["slope_jumps"][k], 1e-9);
        EXPECT_EQ(steps[k].x, 100.0 * static_cast<double>(k) + 95);
    }
    const WindowedFit joined = fit_windows(x, z, {3, 10, WindowJoin::c1});
    for (std::size_t k = 0; k + 1 < numbers["breaks"].size(); ++k) {
        const FitJet jet = joined.piece_at(numbers["breaks"][k]).jet(numbers["breaks"][k]);
        EXPECT_NEAR(jet.z, numbers["values"][k], 1e-9);
        EXPECT_NEAR(jet.slope, numbers["slopes"][k], 1e-9);
    }
}

/// Unevenly spaced positions far from 0, as on a long machine.
std::vector<double> uneven_places(std::size_t count) {
    std::vector<double> x;
    for (std::size_t i = 0; i < count; ++i)
        x.push_back(2150 + 0.5 * static_cast<double>(i) + 0.2 * std::sin(1.7 * static_cast<double>(i)));
    return x;
}

TEST(WindowedFit, APolynomialOfTheDegreeIsReproducedThroughEveryJoin) {
    for (const WindowJoin join : {WindowJoin::c1, WindowJoin::blend, WindowJoin::none}) {
        for (int degree = join == WindowJoin::c1 ? 2 : 1; degree <= most_fit_degree; ++degree) {
            for (const std::size_t count : {23U, 100U, 101U, 113U}) {
                const std::vector<double> x = uneven_places(count);
                const double middle = 0.5 * (x.front() + x.back());
                const auto polynomial = [&](double at, int derivative) {
                    const double u = (at - middle) / 20, n = degree;
                    if (derivative == 0) return 3 + 2 * u + std::pow(u, degree);
                    if (derivative == 1) return (2 + n * std::pow(u, degree - 1)) / 20;
                    return degree < 2 ? 0 : n * (n - 1) * std::pow(u, degree - 2) / 400;
                };
                std::vector<double> z;
                for (const double at : x) z.push_back(polynomial(at, 0));
                const WindowedFit fit = fit_windows(x, z, {degree, 14, join});
                EXPECT_EQ(fit.pieces.front().begin, x.front());
                EXPECT_EQ(fit.pieces.back().end, x.back());
                for (int i = 0; i <= 300; ++i) {
                    const double at = x.front() + (x.back() - x.front()) * i / 300;
                    const FitJet jet = fit.piece_at(at).jet(at);
                    const double size = std::max(1.0, std::abs(polynomial(at, 0)));
                    ASSERT_NEAR(jet.z, polynomial(at, 0), 1e-9 * size) << degree << " of " << count;
                    ASSERT_NEAR(jet.slope, polynomial(at, 1), 1e-8 * size) << degree << " of " << count;
                    ASSERT_NEAR(jet.second, polynomial(at, 2), 1e-6 * size) << degree << " of " << count;
                }
            }
        }
    }
}

TEST(WindowedFit, JoinedWindowsHaveOneValueAndOneSlope) {
    std::vector<double> x = uneven_places(333), z;
    for (std::size_t i = 0; i < x.size(); ++i) z.push_back(std::sin(0.9 * static_cast<double>(i * i % 71)));
    for (const WindowJoin join : {WindowJoin::c1, WindowJoin::blend}) {
        for (const std::size_t window : {7U, 10U, 31U, 1000U}) {
            const WindowedFit fit = fit_windows(x, z, {3, std::min<std::size_t>(window, x.size()), join});
            for (const PieceStep& step : fit.steps()) {
                EXPECT_NEAR(step.z, 0, 1e-10);
                EXPECT_NEAR(step.slope, 0, 1e-9);
            }
            for (std::size_t k = 1; k < fit.pieces.size(); ++k) EXPECT_EQ(fit.pieces[k].begin, fit.pieces[k - 1].end);
        }
    }
    EXPECT_GT(std::abs(fit_windows(x, z, {3, 10, WindowJoin::none}).steps()[3].z), 1e-3) << "that pieces can jump";
}

}  // namespace
}  // namespace clsurf::windowed_fit_test

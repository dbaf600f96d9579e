// Fits compared with independently computed vectors, and properties of fits near points.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "numeric/least_squares.h"
#include "support/vector_rows.h"

namespace clsurf::least_squares_test {
namespace {

class Profile : public testing::Test {
protected:
    void SetUp() override {
        for (VectorRow& row : vector_rows("numeric", "windowed_fit.txt")) {
            for (std::string word = row.word(); !word.empty(); word = row.word())
                numbers_[row.name].push_back(std::stod(word));
        }
        for (const double z : numbers_["heights"]) {
            at_.push_back(10.0 * static_cast<double>(at_.size()));
            points_.emplace_back(at_.back(), 0, z);
        }
    }
    void near(double value, double expected) const { EXPECT_NEAR(value, expected, 1e-7 + 1e-6 * std::abs(expected)); }

    std::map<std::string, std::vector<double>> numbers_;
    std::vector<double> at_;
    std::vector<Vec3> points_;
};

TEST_F(Profile, WindowsOfTenPointsAndTheirJumps) {
    const std::vector<double>& windows = numbers_["windows"];
    ASSERT_EQ(windows.size(), 22U * 6);
    Vec3 value_before = Vec3::Zero(), slope_before = Vec3::Zero();
    for (std::size_t w = 0; w < 22; ++w) {
        const double* const expected = &windows[6 * w];
        const auto points = std::span(points_).subspan(10 * w, 10);
        const auto at = std::span(at_).subspan(10 * w, 10);
        const CubicSpan piece = fit_hermite(at, points, std::vector{at.front(), at.back()}, FitEnds::free).piece(0);
        for (const double u : {-1.0, -0.3, 0.5, 1.0}) {
            const double z = expected[2] + u * (expected[3] + u * (expected[4] + u * expected[5]));
            near(piece.at(45 * (u + 1)).z(), z);
        }
        if (w > 0) {
            near(piece.at(-5).z() - value_before.z(), numbers_["value_jumps"][w - 1]);
            near(piece.derivative(-5).z() - slope_before.z(), numbers_["slope_jumps"][w - 1]);
        }
        value_before = piece.at(95);
        slope_before = piece.derivative(95);
    }
}

TEST_F(Profile, OneCurveWithAContinuousDerivative) {
    const HermiteFit fit = fit_hermite(at_, points_, numbers_["breaks"], FitEnds::free);
    for (std::size_t k = 0; k < fit.breaks.size(); ++k) {
        near(fit.values[k].z(), numbers_["values"][k]);
        near(fit.slopes[k].z(), numbers_["slopes"][k]);
    }
}

TEST(LeastSquaresSpans, GoBesideThePointsOfACubicExactlyAndBackTheSame) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> step(0.2, 1), aside(-0.1, 0.1);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Vec3> points{Vec3::Zero()};
        const int count = 6 + trial % 60;
        for (int i = 0; i < count; ++i)
            points.push_back(points.back() + Vec3(step(random), aside(random), aside(random)));
        const std::vector<CubicSpan> forth = least_squares_spans(points, 10);
        ASSERT_EQ(forth.size() + 1, points.size());
        EXPECT_LT((forth.front().at(0) - points.front()).norm(), 1e-9);
        EXPECT_LT((forth.back().at(forth.back().chord) - points.back()).norm(), 1e-9);
        for (std::size_t i = 1; i < forth.size(); ++i) {
            EXPECT_LT((forth[i].at(0) - forth[i - 1].at(forth[i - 1].chord)).norm(), 1e-9);
            EXPECT_LT((forth[i].derivative(0) - forth[i - 1].derivative(forth[i - 1].chord)).norm(), 1e-9);
        }
        std::reverse(points.begin(), points.end());
        const std::vector<CubicSpan> back = least_squares_spans(points, 10);
        for (std::size_t i = 0; i < forth.size(); ++i) {
            const CubicSpan& other = back[back.size() - 1 - i];
            EXPECT_LT((forth[i].at(0.3 * forth[i].chord) - other.at(0.7 * other.chord)).norm(), 1e-8);
        }
    }
    // A cubic of the path is reproduced exactly: a line with points at any spacing.
    std::vector<Vec3> line{Vec3::Zero()};
    for (int i = 0; i < 30; ++i) line.push_back(line.back() + step(random) * Vec3(0.6, 0, 0.8));
    for (const CubicSpan& span : least_squares_spans(line, 10))
        EXPECT_LT(span.at(0.5 * span.chord).cross(Vec3(0.6, 0, 0.8)).norm(), 1e-9);
}

}  // namespace
}  // namespace clsurf::least_squares_test

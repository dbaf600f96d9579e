// LimitRows, four in parallel, compared with the same sums computed one row and one side at a time.
#include "simulation/plan/limit_rows.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace clsurf::limit_rows_test {
namespace {

constexpr std::size_t coefficients = 12;
using Vector = Eigen::Matrix<double, coefficients, 1>;
using Matrix = Eigen::Matrix<double, coefficients, coefficients>;

struct Made {
    std::vector<LimitRow> rows;
    Vector value;
};

/// Rows that a value satisfies: some of acceleration (m = 1), some of jerk (m = b at their position).
Made make(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Made made;
    for (double& c : made.value) c = uniform(1, 4);
    for (std::size_t k = 0; k < count; ++k) {
        LimitRow row;
        row.cell = static_cast<std::uint32_t>(k * (coefficients - 2) / count);
        row.number = static_cast<std::uint32_t>(k);
        for (double& w : row.w) w = uniform(-0.03, 0.03);
        if (k % 2 == 1) {
            row.v = {uniform(0.1, 0.3), uniform(0.3, 0.6), uniform(0.1, 0.3)};
            row.unit = 0;
            row.kind = Row::axis_jerk;
        } else {
            row.kind = Row::axis_acceleration;
        }
        made.rows.push_back(row);
    }
    return made;
}

/// A side of a row: the distance to its bound, and its gradient.
struct Side {
    double left = 0;
    Vector gradient = Vector::Zero();
};
Side side_of(const LimitRow& row, const Vector& value, double sign) {
    double at = 0, m = row.unit;
    for (std::size_t q = 0; q < 3; ++q) {
        at += row.w[q] * value[static_cast<Eigen::Index>(row.cell + q)];
        m += row.v[q] * value[static_cast<Eigen::Index>(row.cell + q)];
    }
    Side side;
    side.left = 1 / std::sqrt(m) - sign * at;
    for (std::size_t q = 0; q < 3; ++q)
        side.gradient[static_cast<Eigen::Index>(row.cell + q)] = -0.5 * std::pow(m, -1.5) * row.v[q] - sign * row.w[q];
    return side;
}

NewtonSystem empty_system() {
    NewtonSystem newton;
    for (std::vector<double>* part :
         {&newton.d0, &newton.d1, &newton.d2, &newton.pull, &newton.centring, &newton.products})
        part->assign(coefficients, 0);
    return newton;
}

class LimitRowsTest : public testing::TestWithParam<std::size_t> {};

TEST_P(LimitRowsTest, MatrixAndStepsAreTheSumsOverTheirSides) {
    constexpr double centre = 0.01;
    const Made made = make(GetParam(), 7 + GetParam());
    LimitRows rows;
    for (const LimitRow& row : made.rows) rows.add(row);
    rows.begin(made.value.data(), centre, 1e-3);
    NewtonSystem newton = empty_system();
    const LimitRows::Gap gap = rows.assemble(made.value.data(), newton);

    std::mt19937_64 random(3);
    Vector step;
    for (double& c : step) c = std::uniform_real_distribution<double>(-0.5, 0.5)(random);
    Matrix matrix = Matrix::Zero();
    double greatest = 0, change = 0;
    for (const LimitRow& row : made.rows) {
        for (const double sign : {1.0, -1.0}) {
            const Side side = side_of(row, made.value, sign);
            ASSERT_GT(side.left, 0);
            const double multiplier = centre / side.left;
            matrix += multiplier / side.left * side.gradient * side.gradient.transpose();
            greatest = std::max(greatest, -side.gradient.dot(step) / side.left);
            change += multiplier * side.gradient.dot(step);
        }
    }
    const double scale = matrix.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(coefficients); ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_NEAR(newton.d0[k], matrix(i, i), 1e-12 * scale);
        EXPECT_NEAR(newton.d1[k], k + 1 < coefficients ? matrix(i, i + 1) : 0, 1e-12 * scale);
        EXPECT_NEAR(newton.d2[k], k + 2 < coefficients ? matrix(i, i + 2) : 0, 1e-12 * scale);
        EXPECT_EQ(newton.pull[k], 0) << "no limit is broken";
    }
    EXPECT_GE(rows.sides(), 2.0 * static_cast<double>(made.rows.size()));
    EXPECT_NEAR(gap.sum, centre * rows.sides(), 1e-12);
    EXPECT_EQ(gap.broken, 0);
    const LimitRows::Steps steps = rows.predict(step.data(), newton);
    EXPECT_NEAR(steps.primal, greatest, 1e-12);
    EXPECT_NEAR(steps.by_primal, change, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Counts, LimitRowsTest, testing::Values(1, 3, 4, 5, 8, 11));

TEST(LimitRows, TellHowFarALimitIsBroken) {
    LimitRows rows;
    LimitRow row;
    row.w = {0, 1.3, 0};
    rows.add(row);
    std::vector<double> value{1, 1, 1};
    rows.begin(value.data(), 0.01, 1e-3);
    NewtonSystem newton = empty_system();
    // The slack is at a thousandth of the bound; the remaining distance is 1 − 1.3.
    EXPECT_NEAR(rows.assemble(value.data(), newton).broken, 0.301, 1e-12);
    EXPECT_LT(newton.pull[1], 0) << "pulled back";
}

TEST(LimitRows, NameTheNearestLimitOfACell) {
    LimitRows rows;
    LimitRow near, far, jerk;
    near.w = {0, 0.09, 0};
    near.kind = Row::axis_acceleration;
    far.w = {0, 0.05, 0};
    far.kind = Row::tangential_acceleration;
    jerk.w = {0, 0.05, 0};  // 0.05 · 4 of 1/√4: two fifths
    jerk.v = {0, 1, 0};
    jerk.unit = 0;
    jerk.kind = Row::axis_jerk;
    jerk.number = 1;
    std::vector<double> value{4, 4, 4, 4};
    for (const LimitRow& row : {near, far, jerk}) rows.add(row);
    std::vector<Row> nearest(2, Row::cap);
    rows.judge(value.data(), nearest);
    EXPECT_EQ(nearest[0], Row::axis_jerk);
    EXPECT_EQ(nearest[1], Row::cap) << "a cell without rows";
}

}  // namespace
}  // namespace clsurf::limit_rows_test

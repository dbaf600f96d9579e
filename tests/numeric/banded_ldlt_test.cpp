// Banded systems compared with Eigen's dense solution.
#include "numeric/banded_ldlt.h"

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "core/geometry.h"

namespace clsurf::banded_ldlt_test {
namespace {

/// A random positive definite matrix, as diagonals and dense.
template <std::size_t width>
struct System {
    std::array<std::vector<double>, width + 1> diagonals;
    Eigen::MatrixXd dense;

    System(std::size_t size, std::mt19937_64& random) {
        std::uniform_real_distribution<double> uniform(-1, 1);
        const auto n = static_cast<Eigen::Index>(size);
        Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            factor(i, i) = 1.5 + uniform(random);
            for (Eigen::Index k = 1; k <= static_cast<Eigen::Index>(width) && k <= i; ++k)
                factor(i, i - k) = uniform(random);
        }
        dense = factor * factor.transpose();
        for (std::size_t k = 0; k <= width; ++k) {
            // Values below the last row are not read.
            diagonals[k].assign(size, std::numeric_limits<double>::quiet_NaN());
            for (std::size_t i = 0; i + k < size; ++i)
                diagonals[k][i] = dense(static_cast<Eigen::Index>(i + k), static_cast<Eigen::Index>(i));
        }
    }
    [[nodiscard]] BandedDiagonals<width> spans() {
        BandedDiagonals<width> all;
        for (std::size_t k = 0; k <= width; ++k) all[k] = diagonals[k];
        return all;
    }
};

template <std::size_t width>
void solve_as_eigen() {
    std::mt19937_64 random(3 + width);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t size = 1; size <= 40; ++size) {
        System<width> system(size, random);
        ASSERT_TRUE(factorise_banded<width>(system.spans()));
        std::vector<Vec3> right(size);
        for (Vec3& v : right) v = {uniform(random), uniform(random), uniform(random)};
        Eigen::MatrixXd columns(static_cast<Eigen::Index>(size), 3);
        for (std::size_t i = 0; i < size; ++i) columns.row(static_cast<Eigen::Index>(i)) = right[i].transpose();
        std::vector<double> first(size);
        for (std::size_t i = 0; i < size; ++i) first[i] = right[i].x();
        solve_banded<width>(system.spans(), std::span(right));
        solve_banded<width>(system.spans(), std::span(first));
        const Eigen::MatrixXd expected = system.dense.ldlt().solve(columns);
        // Both are backward stable: they differ by the rounding error times the condition number of the matrix.
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(system.dense);
        const double condition = svd.singularValues()(0) / svd.singularValues()(svd.singularValues().size() - 1);
        const double tolerance = 1e-14 * condition * expected.norm();
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_EQ(first[i], right[i].x());
            EXPECT_LT((expected.row(static_cast<Eigen::Index>(i)).transpose() - right[i]).norm(), tolerance) << size;
        }
    }
}

TEST(BandedLdlt, SolvesAsDenseEigenDoes) {
    solve_as_eigen<1>();
    solve_as_eigen<2>();
    solve_as_eigen<3>();
}

TEST(BandedLdlt, RefusesAMatrixThatIsNotPositiveDefinite) {
    // [[1, 2], [2, 1]] has the eigenvalues 3 and −1.
    std::vector<double> main{1, 1}, below{2, 0};
    EXPECT_FALSE(factorise_banded<1>({main, below}));
    main = {1, 5}, below = {2, 0};
    EXPECT_TRUE(factorise_banded<1>({main, below}));
    EXPECT_EQ(main, (std::vector<double>{1, 1})) << "D = diag(1, 5 − 2²)";
    main = {std::numeric_limits<double>::quiet_NaN(), 1}, below = {0, 0};
    EXPECT_FALSE(factorise_banded<1>({main, below}));
    main = {std::numeric_limits<double>::infinity(), 1};
    EXPECT_FALSE(factorise_banded<1>({main, below}));
}

}  // namespace
}  // namespace clsurf::banded_ldlt_test

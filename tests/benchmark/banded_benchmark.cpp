// Compares numeric/banded_ldlt.h with Eigen's SimplicialLDLT: a system with five diagonals, as solved in each step of the
// speed problem, is factorised and solved by both. The argument is its size.
#include <vector>

#include <benchmark/benchmark.h>
#include <Eigen/SparseCholesky>

#include "numeric/banded_ldlt.h"

namespace clsurf {
namespace {

constexpr double main_diagonal = 6, first_below = -2, second_below = 1;

void banded_ldlt_of_ours(benchmark::State& state) {
    const auto size = static_cast<std::size_t>(state.range(0));
    std::vector<double> d0(size), d1(size), d2(size), x(size);
    for (auto _ : state) {
        d0.assign(size, main_diagonal);
        d1.assign(size, first_below);
        d2.assign(size, second_below);
        x.assign(size, 1.0);
        const BandedDiagonals<2> diagonals{d0, d1, d2};
        if (!factorise_banded<2>(diagonals)) state.SkipWithError("not positive definite");
        solve_banded<2>(diagonals, std::span(x));
        benchmark::DoNotOptimize(x.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(banded_ldlt_of_ours)->Arg(50)->Arg(500);

void banded_ldlt_of_eigen(benchmark::State& state) {
    const auto size = static_cast<Eigen::Index>(state.range(0));
    std::vector<Eigen::Triplet<double>> elements;
    for (Eigen::Index i = 0; i < size; ++i) {
        elements.emplace_back(i, i, main_diagonal);
        if (i + 1 < size) elements.emplace_back(i + 1, i, first_below);
        if (i + 2 < size) elements.emplace_back(i + 2, i, second_below);
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(elements.begin(), elements.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver;
    solver.analyzePattern(matrix);
    const Eigen::VectorXd right = Eigen::VectorXd::Ones(size);
    Eigen::VectorXd x(size);
    for (auto _ : state) {
        solver.factorize(matrix);
        x = solver.solve(right);
        benchmark::DoNotOptimize(x.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(banded_ldlt_of_eigen)->Arg(50)->Arg(500);

}  // namespace
}  // namespace clsurf

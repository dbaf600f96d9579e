#pragma once
// L D Lᵀ of a symmetric positive definite matrix with few diagonals (Golub and Van Loan, Matrix Computations, 4th ed.,
// section 4.3), in place. The width is a compile-time constant, so the inner loops are unrolled.
// tests/benchmark/banded_benchmark.cpp compares it with Eigen's SimplicialLDLT, which takes any sparse matrix.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace clsurf {

/// The main diagonal and `width` below it: diagonals[k][i] is element (i + k, i). All are as long as the matrix is high;
/// elements below its last row are not read.
template <std::size_t width>
using BandedDiagonals = std::array<std::span<double>, width + 1>;

namespace detail {

/// Calls f(i, steps) for each row with the number of rows after it, at most `width`: a compile-time constant except for
/// the last rows.
template <std::size_t width, typename F>
void for_each_row(std::size_t size, const F& f) {
    std::size_t i = 0;
    for (; i + width < size; ++i) f(i, width);
    for (; i < size; ++i) f(i, size - 1 - i);
}

}  // namespace detail

/// Replaces the main diagonal by D⁻¹ and the others by those of L. Returns false if the matrix is not positive
/// definite.
template <std::size_t width>
[[nodiscard]] bool factorise_banded(const BandedDiagonals<width>& diagonals) {
    bool positive = true;
    detail::for_each_row<width>(diagonals[0].size(), [&](std::size_t i, std::size_t steps) {
        const double pivot = diagonals[0][i];
        positive = positive && pivot > 0 && std::isfinite(pivot);
        const double inverse = 1 / pivot;
        diagonals[0][i] = inverse;
        for (std::size_t k = 1; k <= steps; ++k) {
            const double l = diagonals[k][i] * inverse;
            for (std::size_t m = k; m <= steps; ++m) diagonals[m - k][i + k] -= l * diagonals[m][i];
        }
        for (std::size_t k = 1; k <= steps; ++k) diagonals[k][i] *= inverse;
    });
    return positive;
}

/// Solves for the right side in x, of doubles or of vectors; x becomes the solution.
template <std::size_t width, typename Value>
void solve_banded(const BandedDiagonals<width>& factors, std::span<Value> x) {
    detail::for_each_row<width>(x.size(), [&](std::size_t i, std::size_t steps) {
        for (std::size_t k = 1; k <= steps; ++k) x[i + k] -= factors[k][i] * x[i];
    });
    for (std::size_t i = x.size(); i-- > 0;) {
        x[i] *= factors[0][i];
        const std::size_t steps = std::min(width, x.size() - 1 - i);
        for (std::size_t k = 1; k <= steps; ++k) x[i] -= factors[k][i] * x[i + k];
    }
}

}  // namespace clsurf

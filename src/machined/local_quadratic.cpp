#include "machined/local_quadratic.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <Eigen/Dense>

#include "core/statistics.h"
#include "core/vectorised.h"

namespace clsurf {
namespace {

constexpr int fits = 3;  ///< number of fits: the first, and two with weights from residuals
// With this constant, bisquare weights are 95 % efficient for normal errors.
constexpr double outlying = 4.685;  ///< robust standard deviations: a place at this distance or farther has weight 0
constexpr double stiffness = 1e-6;  ///< regularisation of terms that the places do not determine

// Four doubles fill a register of 32 bytes.
constexpr std::size_t width = 4;
typedef double Four [[gnu::vector_size(width * sizeof(double))]];

/// Sums of w xⁱ yʲ, ordered by i + j and then by j, and of w z xⁱ yʲ.
struct Moments {
    std::array<double, 15> of_places{};
    std::array<double, 6> of_heights{};
};

void load(const double* values, Four& four) { std::memcpy(&four, values, sizeof four); }

/// `count` is a multiple of the width.
CLSURF_VECTORISED void add_up(const double* x, const double* y, const double* z, const double* weight,
                              const double* robust, std::size_t count, Moments& sums) {
    Four m[15] = {};
    Four h[6] = {};
    for (std::size_t k = 0; k < count; k += width) {
        Four fx, fy, fz, w, by_last;
        load(x + k, fx);
        load(y + k, fy);
        load(z + k, fz);
        load(weight + k, w);
        load(robust + k, by_last);
        w *= by_last;
        const Four wx = w * fx, wy = w * fy, wz = w * fz;
        const Four wxx = wx * fx, wxy = wx * fy, wyy = wy * fy, xx = fx * fx, xy = fx * fy, yy = fy * fy;
        m[0] += w, m[1] += wx, m[2] += wy;
        m[3] += wxx, m[4] += wxy, m[5] += wyy;
        m[6] += wxx * fx, m[7] += wxx * fy, m[8] += wyy * fx, m[9] += wyy * fy;
        m[10] += wxx * xx, m[11] += wxx * xy, m[12] += wxx * yy, m[13] += wxy * yy, m[14] += wyy * yy;
        h[0] += wz, h[1] += wz * fx, h[2] += wz * fy, h[3] += wz * xx, h[4] += wz * xy, h[5] += wz * yy;
    }
    for (std::size_t i = 0; i < 15; ++i) sums.of_places[i] = (m[i][0] + m[i][1]) + (m[i][2] + m[i][3]);
    for (std::size_t i = 0; i < 6; ++i) sums.of_heights[i] = (h[i][0] + h[i][1]) + (h[i][2] + h[i][3]);
}

}  // namespace

void LocalQuadratic::clear() {
    for (std::vector<double>* column : {&x_, &y_, &z_, &weight_}) column->clear();
}

void LocalQuadratic::add(double x, double y, double z, double weight) {
    x_.push_back(x);
    y_.push_back(y);
    z_.push_back(z);
    weight_.push_back(weight);
}

LocalQuadratic::Terms LocalQuadratic::fit(double least_spread) {
    while (size() % width != 0) add(0, 0, 0, 0);
    robust_.assign(size(), 1);
    Terms fitted = solve();
    for (int again = 1; again < fits; ++again) {
        weigh(fitted, least_spread);
        fitted = solve();
    }
    return fitted;
}

LocalQuadratic::Terms LocalQuadratic::solve() {
    Moments sums;
    add_up(x_.data(), y_.data(), z_.data(), weight_.data(), robust_.data(), size(), sums);
    const auto& m = sums.of_places;
    Eigen::Matrix<double, 6, 6> normal;
    normal << m[0], m[1], m[2], m[3], m[4], m[5],  //
        m[1], m[3], m[4], m[6], m[7], m[8],        //
        m[2], m[4], m[5], m[7], m[8], m[9],        //
        m[3], m[6], m[7], m[10], m[11], m[12],     //
        m[4], m[7], m[8], m[11], m[12], m[13],     //
        m[5], m[8], m[9], m[12], m[13], m[14];
    normal.diagonal().array() += stiffness * m[0];
    return normal.ldlt().solve(Eigen::Map<const Terms>(sums.of_heights.data()));
}

void LocalQuadratic::weigh(const Terms& a, double least_spread) {
    left_.resize(size());
    sorted_.clear();
    for (std::size_t k = 0; k < size(); ++k) {
        const double x = x_[k];
        const double y = y_[k];
        left_[k] = std::abs(z_[k] - (a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y));
        if (weight_[k] > 0) sorted_.push_back(left_[k]);
    }
    const double most = outlying * std::max(least_spread, deviation_of_mad * median(sorted_));
    for (std::size_t k = 0; k < size(); ++k) {
        const double share = std::min(1.0, left_[k] / most);
        robust_[k] = (1 - share * share) * (1 - share * share);
    }
}

}  // namespace clsurf

#include "numeric/derivative.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "core/point_count.h"
#include "core/vectorised.h"

namespace clsurf {
namespace {

constexpr double window_seconds = 0.020;
constexpr double jerk_window_seconds = 0.040;

/// out[i] = Σ w[k] · in[i + k]: a loop over taps with vectors along i.
CLSURF_VECTORISED void convolve(const double* in, const double* weights, int taps, double* out, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) out[i] = weights[0] * in[i];
    for (int k = 1; k < taps; ++k) {
        const double w = weights[k];
        const double* shifted = in + k;
        for (std::size_t i = 0; i < n; ++i) out[i] += w * shifted[i];
    }
}

}  // namespace

std::vector<double> derivative_weights(int points, int order, int derivative, int at) {
    // A power basis is worse conditioned the wider the window is. Gram's polynomials p_k are orthogonal on the
    // points, so the weight of point x is Σ p_k(x) p_k⁽ᵈ⁾(at) / |p_k|². p_k+1 = x p_k − b_k p_k−1 with b_k = k² (n² −
    // k²) / (4 (4 k² − 1)), x scaled to −1 … 1.
    const double half = std::max(1.0, 0.5 * (points - 1));
    const auto place = [&](int i) { return (i - 0.5 * (points - 1)) / half; };
    const double n = points, x_at = place(at);
    const auto degree = static_cast<std::size_t>(order), taken = static_cast<std::size_t>(derivative);
    std::vector<double> b(degree + 1, 0.0);
    for (std::size_t k = 1; k <= degree; ++k) {
        const auto kk = static_cast<double>(k * k);
        b[k] = kk * (n * n - kk) / (4 * (4 * kk - 1)) / (half * half);
    }

    // Derivatives of p_k at the point, up to the requested one, over |p_k|².
    std::vector<double> now(taken + 1, 0.0), before(taken + 1, 0.0), next(taken + 1), share(degree + 1);
    now[0] = 1;
    double norm = n;
    for (std::size_t k = 0;; ++k) {
        if (k > 0) norm *= b[k];
        share[k] = now[taken] / norm;
        if (k == degree) break;
        for (std::size_t d = 0; d <= taken; ++d)
            next[d] = x_at * now[d] - b[k] * before[d] + (d > 0 ? static_cast<double>(d) * now[d - 1] : 0.0);
        before.swap(now);
        now.swap(next);
    }

    std::vector<double> weights(static_cast<std::size_t>(points));
    for (int i = 0; i < points; ++i) {
        double p = 1, last = 0, sum = 0;
        for (std::size_t k = 0; k <= degree; ++k) {
            sum += share[k] * p;
            last = std::exchange(p, place(i) * p - b[k] * last);
        }
        weights[static_cast<std::size_t>(i)] = sum / std::pow(half, derivative);
    }
    return weights;
}

DerivativeFilter derivative_filter(int derivative, double period) {
    DerivativeFilter filter;
    filter.derivative = derivative;
    filter.order = std::max(2, derivative);
    filter.period = period;
    const double seconds = derivative >= 3 ? jerk_window_seconds : window_seconds;
    filter.points = window_points(seconds, period, (filter.order + 2) | 1);
    return filter;
}

DerivativeFilter derivative_filter(int derivative, double period, double coarsest) {
    DerivativeFilter filter = derivative_filter(derivative, period);
    const DerivativeFilter other = derivative_filter(derivative, std::max(period, coarsest));
    const double seconds = (other.points - 1) * other.period;
    filter.points = window_points(seconds, period, filter.points);
    return filter;
}

double DerivativeFilter::step_response() const {
    double sum = 0, most = 0;
    for (const double weight : derivative_weights(points, order, derivative, points / 2)) {
        sum += weight;
        most = std::max(most, std::abs(sum));
    }
    return most * std::pow(period, -derivative);
}

double DerivativeFilter::speed_step_response() const {
    const std::vector<double> weights = derivative_weights(points, order, derivative, points / 2);
    // Positions that rest and then move by 1 per record, beginning at each of the points.
    double most = 0, sum = 0, response = 0;
    for (std::size_t k = weights.size(); k-- > 0;) {
        response += sum;
        sum += weights[k];
        most = std::max(most, std::abs(response));
    }
    return most * std::pow(period, 1 - derivative);
}

double DerivativeFilter::bandwidth() const {
    const int middle_point = points / 2;
    const std::vector<double> weights = derivative_weights(points, order, derivative, middle_point);
    const auto gain = [&](double f) {
        const double omega = 2 * std::numbers::pi * f * period;
        std::complex<double> sum = 0;
        for (int k = 0; k < points; ++k)
            sum += weights[static_cast<std::size_t>(k)] * std::polar(1.0, omega * (k - middle_point));
        return std::abs(sum) / std::pow(omega, derivative);
    };
    double low = 0;
    double high = 0.5 / period;
    // The gain falls from 1; the first crossing is below the first zero, near 1 / window.
    const double step = 0.02 / (points * period);
    for (double f = step; f < high; f += step) {
        if (gain(f) >= std::numbers::sqrt2 / 2) continue;
        low = f - step;
        high = f;
        break;
    }
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (middle > 0 && gain(middle) < std::numbers::sqrt2 / 2 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

Differentiator::Differentiator(const DerivativeFilter& filter) : filter_(filter) {
    const double per_second = std::pow(filter.period, -filter.derivative);
    for (int at = 0; at < filter.points; ++at) {
        weights_.push_back(derivative_weights(filter.points, filter.order, filter.derivative, at));
        for (double& w : weights_.back()) w *= per_second;
    }
}

void Differentiator::apply(std::span<const double> samples, PointIndex samples_first, PointRange piece,
                           PointIndex first, std::span<double> out) const {
    const PointIndex last = first + static_cast<PointIndex>(out.size()) - 1;
    const double* const origin = samples.data() - samples_first;  // origin[i] is point i
    const int n = filter_.points;
    if (piece.size() < n) {
        const auto count = static_cast<int>(piece.size());
        for (PointIndex i = first; i <= last; ++i) {
            double value = std::numeric_limits<double>::quiet_NaN();
            if (count > filter_.order) {
                const std::vector<double> w =
                    derivative_weights(count, filter_.order, filter_.derivative, static_cast<int>(i - piece.first));
                value = 0;
                for (int k = 0; k < count; ++k) value += w[static_cast<std::size_t>(k)] * origin[piece.first + k];
                value *= std::pow(filter_.period, -filter_.derivative);
            }
            out[static_cast<std::size_t>(i - first)] = value;
        }
        return;
    }
    const PointIndex half = n / 2;
    const PointIndex inner_first = std::max(first, piece.first + half);
    const PointIndex inner_last = std::min(last, piece.last - half);
    if (inner_first <= inner_last) {
        convolve(origin + inner_first - half, weights_[static_cast<std::size_t>(half)].data(), n,
                 out.data() + (inner_first - first), static_cast<std::size_t>(inner_last - inner_first + 1));
    }
    const auto off_centre = [&](PointIndex i) {
        const PointIndex begin = std::clamp(i - half, piece.first, piece.last - n + 1);
        const std::vector<double>& w = weights_[static_cast<std::size_t>(i - begin)];
        double value = 0;
        for (int k = 0; k < n; ++k) value += w[static_cast<std::size_t>(k)] * origin[begin + k];
        out[static_cast<std::size_t>(i - first)] = value;
    };
    for (PointIndex i = first; i <= std::min(last, inner_first - 1); ++i) off_centre(i);
    for (PointIndex i = std::max(first, inner_last + 1); i <= last; ++i) off_centre(i);
}

}  // namespace clsurf

#include "numeric/kalman_smoother.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace clsurf {
namespace {

// Gains are computed in long double: the variances at the first points differ by twelve orders of magnitude.
using Real = long double;
using RealMatrix = Eigen::Matrix<Real, 4, 4>;
using RealVector = Eigen::Matrix<Real, 4, 1>;

constexpr std::size_t most_filter_steps = 3000;
constexpr double settled = 1e-9;   ///< relative change of a variance per step
constexpr double far_away = 1e-5;  ///< relative: remaining influence of a start
/// Bounds of the first position, speed, acceleration and jerk, which make the start practically unknown: far more
/// than machines reach [mm/s^d], and than the uncertainty of the measurements.
constexpr std::array<double, 4> greatest{0, 2e4, 1e6, 1e9};
constexpr double least_unknown = 1e3, most_unknown = 1e6;  ///< in units of period and position_sigma

constexpr std::array<double, 5> factorials{1, 1, 2, 6, 24};

RealMatrix transition() {
    RealMatrix f = RealMatrix::Zero();
    for (int i = 0; i < 4; ++i) {
        for (int j = i; j < 4; ++j) f(i, j) = 1 / static_cast<Real>(factorials[static_cast<std::size_t>(j - i)]);
    }
    return f;
}

/// Covariance that white snap of density 1 adds in a period of 1.
RealMatrix wandering_of_one() {
    RealMatrix q;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            q(i, j) = 1 / static_cast<Real>(factorials[static_cast<std::size_t>(3 - i)] *
                                            factorials[static_cast<std::size_t>(3 - j)] * (7 - i - j));
        }
    }
    return q;
}

/// Updates a covariance with a measured derivative, in Joseph's form; returns the gain.
RealVector update(RealMatrix& p, int derivative, Real variance) {
    const RealVector gain = p.col(derivative) / (p(derivative, derivative) + variance);
    RealMatrix keep = RealMatrix::Identity();
    keep.col(derivative) -= gain;
    p = keep * p * keep.transpose() + variance * gain * gain.transpose();
    return gain;
}

RealMatrix back_gain(const RealMatrix& filtered, const RealMatrix& f, const RealMatrix& predicted) {
    // Scaled to a unit diagonal: variances of position and jerk differ by many orders of magnitude.
    const RealVector scale = predicted.diagonal().cwiseSqrt().cwiseInverse();
    const RealMatrix scaled = scale.asDiagonal() * predicted * scale.asDiagonal();
    const RealMatrix right = scale.asDiagonal() * f * filtered;
    return (scale.asDiagonal() * scaled.ldlt().solve(right)).transpose();
}

Eigen::Array4d lanes(const std::array<std::span<const double>, 3>& values, std::size_t i) {
    return {values[0][i], values[1][i], values[2][i], 0.0};
}

/// The greatest relative change of a variance.
Real change_of(const RealMatrix& from, const RealMatrix& to) {
    return ((to - from).diagonal().cwiseAbs().cwiseQuotient(to.diagonal())).maxCoeff();
}

/// What a backward step adds to the variance: (1 − C F) P (1 − C F)ᵀ + C Q Cᵀ, without cancellation.
RealMatrix variance_alone(const RealMatrix& filtered, const RealMatrix& back, const RealMatrix& f,
                          const RealMatrix& q) {
    const RealMatrix stay = RealMatrix::Identity() - back * f;
    return stay * filtered * stay.transpose() + back * q * back.transpose();
}

/// The first point whose prediction is nearly as certain as those far from the start. `filtered`: covariances after a
/// point.
template <typename Matrices>
std::size_t first_sure_prediction(const Matrices& filtered, double wandering, double innovation_variance) {
    constexpr double nearly = 1.2;
    const Eigen::RowVector4d ahead = transition().row(0).cast<double>();
    const double added = wandering * static_cast<double>(wandering_of_one()(0, 0));
    std::size_t i = 1;
    while (i < filtered.size() &&
           ahead.dot(filtered[i - 1] * ahead.transpose()) + added + 1 > nearly * innovation_variance)
        ++i;
    return i;
}

/// Variances backward from an end, with settled gains before it.
std::vector<std::array<double, 4>> variances_at_end(const RealMatrix& last, const RealMatrix& back,
                                                    const RealMatrix& alone) {
    std::vector<std::array<double, 4>> variances;
    RealMatrix smoothed = last;
    while (variances.size() < most_filter_steps) {
        std::array<double, 4> variance{};
        for (int k = 0; k < 4; ++k) variance[static_cast<std::size_t>(k)] = static_cast<double>(smoothed(k, k));
        variances.push_back(variance);
        const RealMatrix before = alone + back * smoothed * back.transpose();
        const Real change = change_of(smoothed, before);
        smoothed = before;
        if (change < settled) break;
    }
    return variances;
}

}  // namespace

KalmanSmoother::KalmanSmoother(const SmootherModel& model) : model_(model) {
    const RealMatrix f = transition();
    const RealMatrix q = model.wandering * wandering_of_one();
    const Real t = model.period;
    const Real unit = model.position_sigma;
    const auto squared = [](Real x) { return x * x; };
    const Real speed_variance = model.has_speed() ? squared(model.speed_sigma * t / unit) : 0;
    const Real acceleration_variance = model.has_acceleration() ? squared(model.acceleration_sigma * t * t / unit) : 0;
    RealMatrix predicted = RealMatrix::Zero();
    const std::array<double, 4> scale = unit_of_state();
    for (std::size_t d = 0; d < 4; ++d) {
        predicted(static_cast<int>(d), static_cast<int>(d)) =
            squared(std::clamp(greatest[d] / scale[d], least_unknown, most_unknown));
    }
    std::vector<RealMatrix> predicted_all;
    RealMatrix last_filtered, last_back;
    while (forward_.size() < most_filter_steps) {
        Step step;
        RealMatrix filtered = predicted;
        const auto take = [&](int derivative, Real variance) {
            const RealVector gain = update(filtered, derivative, variance);
            for (int k = 0; k < 4; ++k)
                step.gain[static_cast<std::size_t>(derivative)][static_cast<std::size_t>(k)] =
                    static_cast<double>(gain[k]);
        };
        take(0, 1);
        if (model.has_speed()) take(1, speed_variance);
        if (model.has_acceleration()) take(2, acceleration_variance);
        const RealMatrix next = f * filtered * f.transpose() + q;
        const RealMatrix back = back_gain(filtered, f, next);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j)
                step.back[i][j] = static_cast<double>(back(static_cast<int>(i), static_cast<int>(j)));
        }
        forward_.push_back(step);
        last_filtered = filtered;
        last_back = back;
        predicted_all.push_back(predicted);
        alone_.push_back(variance_alone(filtered, back, f, q).cast<double>());
        filtered_.push_back(filtered.cast<double>());
        const Real change = change_of(predicted, next);
        predicted = next;
        if (change < settled) break;
    }
    innovation_variance_ = static_cast<double>(predicted(0, 0) + 1);
    end_variance_ = variances_at_end(last_filtered, last_back, variance_alone(last_filtered, last_back, f, q));
    // How far an unknown start influences later points.
    std::size_t reach = forward_.size();
    while (reach > 1) {
        if (change_of(predicted_all[reach - 1], predicted) > far_away) break;
        --reach;
    }
    const auto n = std::min(forward_.size(), reach + 1);
    Step settled_step = forward_.back();
    forward_.resize(n);
    alone_.resize(n);
    filtered_.resize(n);
    forward_.back() = settled_step;
}

std::array<double, 4> KalmanSmoother::unit_of_state() const {
    std::array<double, 4> unit{};
    for (std::size_t d = 0; d < 4; ++d)
        unit[d] = model_.position_sigma / std::pow(model_.period, static_cast<double>(d));
    return unit;
}

void KalmanSmoother::smooth(const Measurements& measured, std::span<SmoothedState> states,
                            std::span<Eigen::Array4d> innovations) const {
    if (states.empty()) return;
    const std::array<double, 4> unit = unit_of_state();
    Eigen::Array4d origin = lanes(measured.position, 0);
    origin = origin.isNaN().select(0.0, origin);
    const bool speeds = model_.has_speed();
    const bool accelerations = model_.has_acceleration();
    const std::size_t sure =
        innovations.empty() ? 0 : first_sure_prediction(filtered_, model_.wandering, innovation_variance_);
    SmoothedState x{Eigen::Array4d::Zero(), Eigen::Array4d::Zero(), Eigen::Array4d::Zero(), Eigen::Array4d::Zero()};
    const auto predict = [](const SmoothedState& s) {
        return SmoothedState{s[0] + s[1] + 0.5 * s[2] + (1.0 / 6) * s[3], s[1] + s[2] + 0.5 * s[3], s[2] + s[3], s[3]};
    };
    for (std::size_t i = 0; i < states.size(); ++i) {
        const Step& now = step(i);
        if (i > 0) x = predict(x);
        const auto take = [&](std::size_t d, const Eigen::Array4d& value) {
            Eigen::Array4d off = value / unit[d] - x[d];
            off = off.isNaN().select(0.0, off);
            for (std::size_t k = 0; k < 4; ++k) x[k] += now.gain[d][k] * off;
        };
        const Eigen::Array4d position = lanes(measured.position, i) - origin;
        if (!innovations.empty()) {
            const Eigen::Array4d off = (position / unit[0] - x[0]) / std::sqrt(innovation_variance_);
            innovations[i] = i < sure ? Eigen::Array4d::Zero() : Eigen::Array4d(off.isNaN().select(0.0, off));
        }
        take(0, position);
        if (speeds) take(1, lanes(measured.speed, i));
        if (accelerations) take(2, lanes(measured.acceleration, i));
        states[i] = x;
    }
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        const Step& now = step(i);
        const SmoothedState ahead = predict(states[i]);
        SmoothedState off;
        for (std::size_t k = 0; k < 4; ++k) off[k] = x[k] - ahead[k];
        for (std::size_t k = 0; k < 4; ++k) {
            x[k] = states[i][k] + now.back[k][0] * off[0] + now.back[k][1] * off[1] + now.back[k][2] * off[2] +
                   now.back[k][3] * off[3];
        }
        states[i] = x;
    }
    for (SmoothedState& state : states) {
        for (std::size_t k = 0; k < 4; ++k) state[k] *= unit[k];
        state[0] += origin;
    }
}

double KalmanSmoother::sigma(int derivative) const {
    const auto d = static_cast<std::size_t>(derivative);
    return std::sqrt(end_variance_.back()[d]) * unit_of_state()[d];
}

void KalmanSmoother::sigmas(int derivative, PointIndex count, PointIndex first, std::span<double> out) const {
    const auto d = static_cast<std::size_t>(derivative);
    const double unit = unit_of_state()[d];
    const auto settled_after = static_cast<PointIndex>(end_variance_.size()) - 1;
    if (count > reach() + settled_after) {
        // A motion with white snap has the same statistics backward and forward: both ends are alike.
        for (std::size_t i = 0; i < out.size(); ++i) {
            const PointIndex at = first + static_cast<PointIndex>(i);
            const PointIndex from_end = std::min({at, count - 1 - at, settled_after});
            out[i] = std::sqrt(end_variance_[static_cast<std::size_t>(from_end)][d]) * unit;
        }
        return;
    }
    const auto of_step = [](const std::vector<Matrix>& all, PointIndex i) -> const Matrix& {
        return all[std::min(static_cast<std::size_t>(i), all.size() - 1)];
    };
    Matrix smoothed = of_step(filtered_, count - 1);
    for (PointIndex i = count - 1; i >= first; --i) {
        if (i < count - 1) {
            const Matrix back = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(
                step(static_cast<std::size_t>(i)).back[0].data());
            smoothed = of_step(alone_, i) + back * smoothed * back.transpose();
        }
        const PointIndex at = i - first;
        if (at < static_cast<PointIndex>(out.size()))
            out[static_cast<std::size_t>(at)] = std::sqrt(std::max(0.0, smoothed(derivative, derivative))) * unit;
    }
}

KalmanSmoother::Innovations KalmanSmoother::innovations(std::span<const double> positions) const {
    Innovations sums;
    sums.log_variance = std::log(innovation_variance_);
    std::array<double, 4> x{};
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (i > 0) x = {x[0] + x[1] + 0.5 * x[2] + x[3] / 6, x[1] + x[2] + 0.5 * x[3], x[2] + x[3], x[3]};
        const double off = positions[i] - positions[0] - x[0];
        if (std::isnan(off)) break;
        const Step& now = step(i);
        for (std::size_t k = 0; k < 4; ++k) x[k] += now.gain[0][k] * off;
        if (static_cast<PointIndex>(i) < reach()) continue;
        sums.squares += off * off / innovation_variance_;
        ++sums.count;
    }
    return sums;
}

}  // namespace clsurf

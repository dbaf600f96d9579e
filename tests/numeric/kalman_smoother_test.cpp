// The smoother compared with a batch solution of the same problem, with polynomials, and with motions drawn from its model,
// for which its errors must have the stated size.

#include "numeric/kalman_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

namespace clsurf::kalman_smoother_test {
namespace {

using State = Eigen::Vector4d;

constexpr double period = 0.001;

Eigen::Matrix4d transition(double t) {
    Eigen::Matrix4d f;
    f << 1, t, t * t / 2, t * t * t / 6, 0, 1, t, t * t / 2, 0, 0, 1, t, 0, 0, 0, 1;
    return f;
}

/// ∫ g(τ) g(τ)ᵀ dτ over a period, g = (τ³/6, τ²/2, τ, 1), by Gauss quadrature with five points, which is exact for this
/// order.
Eigen::Matrix4d wandering(double t, double density) {
    constexpr std::array<double, 5> nodes{0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                          -0.9061798459386640};
    constexpr std::array<double, 5> weights{0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                            0.2369268850561891, 0.2369268850561891};
    Eigen::Matrix4d q = Eigen::Matrix4d::Zero();
    for (std::size_t i = 0; i < 5; ++i) {
        const double s = 0.5 * t * (1 + nodes[i]);
        const State g(s * s * s / 6, s * s / 2, s, 1);
        q += 0.5 * t * weights[i] * density * g * g.transpose();
    }
    return q;
}

SmootherModel model_of(double density) {
    SmootherModel model;
    model.period = period;
    model.position_sigma = 0.0005;
    model.speed_sigma = 0.3;
    model.acceleration_sigma = 40;
    model.wandering = density * std::pow(period, 7) / (model.position_sigma * model.position_sigma);
    return model;
}

struct Motion {
    std::vector<State> truth;
    std::array<std::vector<double>, 3> measured;
};

/// A motion drawn from the model, with its measurements.
Motion draw(const SmootherModel& model, int count, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double density = model.wandering * model.position_sigma * model.position_sigma / std::pow(model.period, 7);
    // Scaled to units of the period, in which the root of the covariance is well conditioned.
    const Eigen::Matrix4d root =
        Eigen::LLT<Eigen::Matrix4d>(wandering(1, density * std::pow(model.period, 7))).matrixL();
    const State unit(1, 1 / model.period, 1 / std::pow(model.period, 2), 1 / std::pow(model.period, 3));
    Motion motion;
    State x(3, 40, 500, -2000);
    for (int i = 0; i < count; ++i) {
        if (i > 0)
            x = transition(model.period) * x +
                State(unit.array() *
                      (root * State(normal(random), normal(random), normal(random), normal(random))).array());
        motion.truth.push_back(x);
        const std::array<double, 3> sigma{model.position_sigma, model.speed_sigma, model.acceleration_sigma};
        for (std::size_t d = 0; d < 3; ++d) {
            const double off = normal(random);
            motion.measured[d].push_back(std::isfinite(sigma[d]) ? x[static_cast<int>(d)] + sigma[d] * off : 0.0);
        }
    }
    return motion;
}

std::vector<SmoothedState> smooth(const KalmanSmoother& smoother, const Motion& motion) {
    std::vector<SmoothedState> states(motion.truth.size());
    const auto& [p, v, a] = motion.measured;
    smoother.smooth({{p, p, p}, {v, v, v}, {a, a, a}}, states);
    return states;
}

double sigma_at(const KalmanSmoother& smoother, int derivative, PointIndex at, PointIndex count) {
    double sigma = 0;
    smoother.sigmas(derivative, count, at, {&sigma, 1});
    return sigma;
}

// All measurements and all steps as one weighted least-squares problem, without recursion.
TEST(KalmanSmoother, IsTheSolutionOfTheBatchProblem) {
    std::mt19937 random(3);
    constexpr int n = 40;
    for (const double density : {1e13, 1e16, 1e18}) {
        const SmootherModel model = model_of(density);
        const Motion motion = draw(model, n, random);
        const State unit(model.position_sigma, model.position_sigma / period,
                         model.position_sigma / std::pow(period, 2), model.position_sigma / std::pow(period, 3));
        const Eigen::Matrix4d f = transition(1);
        const Eigen::Matrix4d steps = Eigen::LLT<Eigen::Matrix4d>(wandering(1, model.wandering)).matrixL();
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * n + 4 * (n - 1), 4 * n);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(rows.rows());
        const std::array<double, 3> sigma{model.position_sigma, model.speed_sigma, model.acceleration_sigma};
        for (int i = 0; i < n; ++i) {
            for (int d = 0; d < 3; ++d) {
                rows(3 * i + d, 4 * i + d) = unit[d] / sigma[static_cast<std::size_t>(d)];
                const double origin = d == 0 ? motion.measured[0][0] : 0.0;
                right[3 * i + d] =
                    (motion.measured[static_cast<std::size_t>(d)][static_cast<std::size_t>(i)] - origin) /
                    sigma[static_cast<std::size_t>(d)];
            }
            if (i == 0) continue;
            const Eigen::Matrix4d whiten = steps.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity());
            rows.block<4, 4>(3 * n + 4 * (i - 1), 4 * i) = whiten;
            rows.block<4, 4>(3 * n + 4 * (i - 1), 4 * (i - 1)) = -whiten * f;
        }
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows);
        const Eigen::VectorXd solution = qr.solve(right);
        const Eigen::MatrixXd r = qr.matrixQR().topRows(4 * n).triangularView<Eigen::Upper>();
        const Eigen::MatrixXd inverse = r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(4 * n, 4 * n));
        const KalmanSmoother smoother(model);
        const std::vector<SmoothedState> states = smooth(smoother, motion);
        for (int i = 0; i < n; ++i) {
            for (int d = 0; d < 4; ++d) {
                const double left = std::sqrt(inverse.row(4 * i + d).squaredNorm()) * unit[d];
                const double origin = d == 0 ? motion.measured[0][0] : 0.0;
                EXPECT_NEAR(states[static_cast<std::size_t>(i)][static_cast<std::size_t>(d)][0],
                            solution[4 * i + d] * unit[d] + origin, 1e-4 * left)
                    << density << ' ' << i << ' ' << d;
                EXPECT_NEAR(sigma_at(smoother, d, i, n), left, 1e-4 * left) << density << ' ' << i << ' ' << d;
            }
        }
    }
}

TEST(KalmanSmoother, IsExactOnCubics) {
    SmootherModel model;
    model.period = period;
    model.position_sigma = 0.0003;
    for (const double wandering : {1e-3, 1e-9, 1e-13}) {
        model.wandering = wandering;
        const KalmanSmoother smoother(model);
        Motion motion;
        const State begin(120, 250, -1500, 40000);
        for (int i = 0; i < 700; ++i) {
            motion.truth.push_back(transition(i * period) * begin);
            motion.measured[0].push_back(motion.truth.back()[0]);
        }
        motion.measured[1] = motion.measured[2] = motion.measured[0];
        const std::vector<SmoothedState> states = smooth(smoother, motion);
        for (std::size_t i = 0; i < states.size(); ++i) {
            for (int d = 0; d < 4; ++d) {
                const double left = sigma_at(smoother, d, static_cast<PointIndex>(i), 700);
                ASSERT_NEAR(states[i][static_cast<std::size_t>(d)][1], motion.truth[i][d], 1e-3 * left)
                    << wandering << ' ' << i << ' ' << d;
            }
        }
    }
}

// Normalised estimation error squared: its mean over many motions is 1 within the expected scatter (with N
// independent errors, ± 4 √(2/N)).
TEST(KalmanSmoother, ErrsAsMuchAsItSays) {
    std::mt19937 random(4);
    SmootherModel positions_only = model_of(1e16);
    positions_only.speed_sigma = positions_only.acceleration_sigma = std::numeric_limits<double>::infinity();
    for (const SmootherModel& model : {model_of(1e16), positions_only}) {
        const KalmanSmoother smoother(model);
        const int count = static_cast<int>(3 * smoother.reach() + 200);
        constexpr int motions = 1500;
        const std::vector<PointIndex> places{0, 1, 5, count / 2, count - 3, count - 1};
        std::vector<std::array<double, 4>> sums(places.size());
        for (int m = 0; m < motions; ++m) {
            const Motion motion = draw(model, count, random);
            const std::vector<SmoothedState> states = smooth(smoother, motion);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const auto at = static_cast<std::size_t>(places[k]);
                for (int d = 0; d < 4; ++d) {
                    const double off = (states[at][static_cast<std::size_t>(d)][0] - motion.truth[at][d]) /
                                       sigma_at(smoother, d, places[k], count);
                    sums[k][static_cast<std::size_t>(d)] += off * off;
                }
            }
        }
        for (std::size_t k = 0; k < places.size(); ++k) {
            for (int d = 0; d < 4; ++d)
                EXPECT_NEAR(sums[k][static_cast<std::size_t>(d)] / motions, 1, 4 * std::sqrt(2.0 / motions))
                    << places[k] << ' ' << d;
        }
    }
}

TEST(KalmanSmoother, PartsOfALongRunAgree) {
    std::mt19937 random(5);
    const SmootherModel model = model_of(1e16);
    const KalmanSmoother smoother(model);
    const Motion motion = draw(model, 4000, random);
    const std::vector<SmoothedState> whole = smooth(smoother, motion);
    const auto reach = static_cast<std::size_t>(smoother.reach());
    Motion part;
    const std::size_t from = 2000 - reach;
    part.truth.resize(2 * reach + 1);
    for (std::size_t d = 0; d < 3; ++d)
        part.measured[d].assign(motion.measured[d].begin() + static_cast<std::ptrdiff_t>(from),
                                motion.measured[d].begin() + static_cast<std::ptrdiff_t>(from + 2 * reach + 1));
    const std::vector<SmoothedState> states = smooth(smoother, part);
    for (int d = 0; d < 4; ++d) {
        const double value = whole[2000][static_cast<std::size_t>(d)][0];
        EXPECT_NEAR(states[reach][static_cast<std::size_t>(d)][0], value,
                    1e-3 * smoother.sigma(d) + 1e-14 * std::abs(value))
            << d;
    }
}

}  // namespace
}  // namespace clsurf::kalman_smoother_test

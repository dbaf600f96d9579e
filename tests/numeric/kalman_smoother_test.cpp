// The smoother against a batch solution of the same problem, on polynomials, and against the truth of
// made motions: are its errors as large as it says, and smaller than those of a window?

#include "numeric/kalman_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "numeric/derivative.h"
#include "toolpath/motion_estimate.h"

namespace clsurf {
namespace {

using State = Eigen::Vector4d;

constexpr double period = 0.001;

Eigen::Matrix4d transition(double t) {
    Eigen::Matrix4d f;
    f << 1, t, t * t / 2, t * t * t / 6, 0, 1, t, t * t / 2, 0, 0, 1, t, 0, 0, 0, 1;
    return f;
}

/// ∫ g(τ) g(τ)ᵀ dτ over a period, g = (τ³/6, τ²/2, τ, 1), by Gauss's five points: exact for its order.
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

/// A motion drawn from the model, and what is measured of it.
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

// All measurements and all steps as one weighted least-squares problem, solved at once: no recursion in it.
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

// Normalised estimation error squared: its mean over many motions is 1, within what chance allows (with N
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

/// A circle of radius 20 whose speed goes up and down between 30 and 60 mm/s in jerk-limited ramps.
struct Ramps {
    static constexpr int count = 12000;
    std::array<std::vector<double>, 3> positions;
    std::vector<double> speeds, exact_speed;  ///< recorded [mm/min]; true [mm/s]
    std::vector<Vec3> velocity, acceleration;
    Log log;
    std::vector<PointRange> pieces{{0, count - 1}};

    Ramps(double quantum, bool with_speed) {
        constexpr int fine = 50;
        constexpr double step = period / fine;
        constexpr double jerk = 60000;
        double s = 0, v = 30, a = 0;
        for (int i = 0; i < count; ++i) {
            const double angle = s / 20;
            const Vec3 along(-std::sin(angle), std::cos(angle), 0);
            const Vec3 inward(-std::cos(angle), -std::sin(angle), 0);
            const Vec3 p(20 * std::cos(angle), 20 * std::sin(angle), 4);
            for (int k = 0; k < 3; ++k)
                positions[static_cast<std::size_t>(k)].push_back(std::round(p[k] / quantum) * quantum);
            exact_speed.push_back(v);
            velocity.push_back(v * along);
            acceleration.push_back(a * along + v * v / 20 * inward);
            speeds.push_back(std::round(v * 60));
            for (int f = 0; f < fine; ++f) {
                // Every 0.3 s a ramp of 2 · 22.36 ms, up and down in turn: 60000 · 0.02236² = 30 mm/s.
                const double t = std::fmod(i * period + f * step, 0.3) - 0.1;
                const bool up = std::fmod(i * period + f * step, 0.6) < 0.3;
                constexpr double half = 0.0223606797749979;
                const double j = t < 0 || t >= 2 * half ? 0 : (t < half ? jerk : -jerk) * (up ? 1 : -1);
                s += v * step + 0.5 * a * step * step;
                v += a * step;
                a += j * step;
                if (t < 0 || t >= 2 * half) a = 0;
            }
        }
        log.name = "ramps";
        log.period = period;
        log.records = count;
        const auto view = [](const std::vector<double>& x) {
            return ChannelView{reinterpret_cast<const std::byte*>(x.data()), 8, count, ScalarType::f64, false, 1, 0};
        };
        for (std::size_t k = 0; k < 3; ++k)
            log.channels.push_back({std::string("cmd.") + "xyz"[k], "mm", view(positions[k])});
        if (with_speed) log.channels.push_back({"speed", "mm/min", view(speeds)});
    }

    struct Errors {
        double speed = 0, acceleration = 0;  ///< rms
    };
    [[nodiscard]] Errors kalman(std::string* note = nullptr, double* speed_sigma = nullptr,
                                double* acceleration_sigma = nullptr) const {
        const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
        const MotionEstimate estimate(log, path, pieces);
        if (note != nullptr) *note = estimate.note(2);
        if (speed_sigma != nullptr) *speed_sigma = estimate.sigma(1);
        if (acceleration_sigma != nullptr) *acceleration_sigma = estimate.sigma(2);
        MotionEstimate::Scratch scratch;
        std::array<std::array<std::vector<double>, 3>, 4> out;
        estimate.estimate(pieces[0], 0, count - 1, scratch, out);
        return errors(out[1], out[2]);
    }
    [[nodiscard]] Errors window() const {
        std::array<std::array<std::vector<double>, 3>, 2> out;
        for (int d = 1; d <= 2; ++d) {
            const Differentiator filter(derivative_filter(d, period));
            for (std::size_t k = 0; k < 3; ++k) {
                std::vector<double>& values = out[static_cast<std::size_t>(d - 1)][k];
                values.resize(count);
                filter.apply(positions[k], 0, pieces[0], 0, values);
            }
        }
        return errors(out[0], out[1]);
    }

private:
    [[nodiscard]] Errors errors(const std::array<std::vector<double>, 3>& v,
                                const std::array<std::vector<double>, 3>& a) const {
        Errors sums;
        int n = 0;
        for (std::size_t i = 100; i + 100 < count; ++i, ++n) {
            const Vec3 speed(v[0][i], v[1][i], v[2][i]);
            sums.speed += std::pow(speed.norm() - exact_speed[i], 2);
            sums.acceleration += (Vec3(a[0][i], a[1][i], a[2][i]) - acceleration[i]).squaredNorm();
        }
        return {std::sqrt(sums.speed / n), std::sqrt(sums.acceleration / n)};
    }
};

TEST(MotionEstimate, KnowsMoreThanAWindowWhereTheSpeedIsRecorded) {
    const Ramps ramps(0.001, true);
    const Ramps::Errors ours = ramps.kalman();
    const Ramps::Errors window = ramps.window();
    EXPECT_LT(ours.speed, 0.5 * window.speed) << ours.speed << " against " << window.speed;
    EXPECT_LT(ours.acceleration, 0.6 * window.acceleration) << ours.acceleration << " against " << window.acceleration;
}

TEST(MotionEstimate, SaysWhatPositionsAloneCannotTell) {
    double speed_sigma = 0, acceleration_sigma = 0, known_speed = 0;
    std::string note;
    const Ramps::Errors blind = Ramps(0.001, false).kalman(&note, &speed_sigma, &acceleration_sigma);
    (void)Ramps(0.001, true).kalman(nullptr, &known_speed);
    EXPECT_NE(note.find("acceleration known to"), std::string::npos) << note;
    EXPECT_LT(known_speed, 0.5 * speed_sigma);
    // What it says it does not know is what it does not know: speed one component, acceleration two of them
    // (z stands still).
    EXPECT_GT(blind.speed, 0.4 * speed_sigma);
    EXPECT_LT(blind.speed, 2 * speed_sigma);
    EXPECT_GT(blind.acceleration, 0.4 * acceleration_sigma * std::sqrt(2));
    EXPECT_LT(blind.acceleration, 2 * acceleration_sigma * std::sqrt(2));
    const Ramps::Errors window = Ramps(0.001, false).window();
    EXPECT_LT(blind.acceleration, window.acceleration);
}

TEST(MotionEstimate, MissingPositionsStayMissing) {
    Ramps ramps(0.001, false);
    for (std::size_t k = 0; k < 3; ++k) ramps.positions[k][5000] = std::nan("");
    const Trajectory path = reconstruct(ramps.log, Role::commanded, Vec3::Zero());
    const MotionEstimate estimate(ramps.log, path, ramps.pieces);
    MotionEstimate::Scratch scratch;
    std::array<std::array<std::vector<double>, 3>, 4> out;
    estimate.estimate(ramps.pieces[0], 4900, 5100, scratch, out);
    for (int i = 0; i <= 200; ++i) {
        EXPECT_EQ(std::isnan(out[1][0][static_cast<std::size_t>(i)]), i == 100) << i;
        if (i == 100) continue;
        EXPECT_NEAR(out[1][0][static_cast<std::size_t>(i)], ramps.velocity[static_cast<std::size_t>(4900 + i)].x(),
                    1.5);
    }
}

}  // namespace
}  // namespace clsurf

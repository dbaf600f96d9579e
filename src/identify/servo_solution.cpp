#include "identify/servo_solution.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Dense>

namespace clsurf {
namespace {

struct Bounds {
    double low, high;
};

Bounds bounds_of(ServoTerm term, double period) {
    switch (term) {
        case ServoTerm::log_gain: return {std::log(0.1), std::log(0.95 / period)};
        case ServoTerm::feedforward: return {-0.5, 2};  // below 0 only during the search: a bound would hinder it
        case ServoTerm::velocity_step: return {0.002, 1};
        case ServoTerm::dead_time: return {0, 99};
        case ServoTerm::integral_step: return {0, 1};
        case ServoTerm::offset: return {-INFINITY, INFINITY};
        default: return {0, INFINITY};
    }
}

/// α and β of ServoLags.
struct LoopLags {
    double alpha, beta;
};

LoopLags lags_without_dead_time(const ServoParameters& p, double period) {
    const double gain = std::exp(p[ServoTerm::log_gain]);
    const double alpha = (1 - p[ServoTerm::feedforward]) / gain;
    return {alpha, (period * (1 / p[ServoTerm::velocity_step] - 1) - alpha) / gain};
}

/// Coordinates in which a search takes straight steps: the values that the records determine at low frequencies. The
/// position lags by A v + B a + C sign(v) at the speed v and the acceleration a. With the gain K, the feed-forward c, the
/// step s of the velocity loop, the dead time d periods of T, the friction f and the backlash b,
///     α = A − d T = (1 − c)/K,   β = B + α d T + (d T)²/2 = (T (1/s − 1) − α)/K,   C = f/K + b/2
/// (steady motion of the difference equation of ServoLoop; half a period of α in B is neglected). They replace c, s and f.
/// With an integral they are still valid coordinates, but β does not determine s at low frequencies.
class ServoLags {
public:
    ServoLags(const ServoParameters& p, double period)
        : lags_(lags_of_loop(p, period)), period_(period), slope_(ServoMatrix::Identity()) {
        const double gain = std::exp(p[ServoTerm::log_gain]), dead = p[ServoTerm::dead_time] * period;
        const double step = p[ServoTerm::velocity_step];
        const auto [alpha, beta] = lags_without_dead_time(p, period);
        const auto set = [&](ServoTerm of, ServoTerm by, double value) {
            slope_(static_cast<Eigen::Index>(index_of(of)), static_cast<Eigen::Index>(index_of(by))) = value;
        };
        set(ServoTerm::feedforward, ServoTerm::log_gain, -alpha * gain);
        set(ServoTerm::feedforward, ServoTerm::feedforward, -gain);
        set(ServoTerm::feedforward, ServoTerm::dead_time, gain * period);
        // 1/s − 1 = (β K + α)/T, and β changes with α and d at a given B.
        const double by_lag = -step * step / period;
        set(ServoTerm::velocity_step, ServoTerm::log_gain, by_lag * beta * gain);
        set(ServoTerm::velocity_step, ServoTerm::feedforward, by_lag * (gain * dead + 1));
        set(ServoTerm::velocity_step, ServoTerm::velocity_step, by_lag * gain);
        set(ServoTerm::velocity_step, ServoTerm::dead_time, by_lag * (gain * alpha - 1) * period);
        if (!p.has(ServoTerm::friction)) return;
        set(ServoTerm::friction, ServoTerm::log_gain, p[ServoTerm::friction]);
        set(ServoTerm::friction, ServoTerm::friction, gain);
        set(ServoTerm::friction, ServoTerm::backlash, -gain / 2);
    }

    /// Derivatives of the parameters by these coordinates.
    [[nodiscard]] const ServoMatrix& slope() const { return slope_; }

    /// The parameters after a step.
    [[nodiscard]] ServoParameters stepped(const ServoVector& step) const {
        ServoParameters p = lags_;
        for (std::size_t k = 0; k < servo_terms; ++k) {
            if (p.active[k] && std::isfinite(step[static_cast<Eigen::Index>(k)]))
                p.value[k] += step[static_cast<Eigen::Index>(k)];
        }
        const auto clamp = [&](ServoTerm term) {
            const Bounds bounds = bounds_of(term, period_);
            p[term] = std::clamp(p[term], bounds.low, bounds.high);
        };
        for (const ServoTerm term :
             {ServoTerm::log_gain, ServoTerm::dead_time, ServoTerm::backlash, ServoTerm::integral_step})
            clamp(term);
        p = loop_of_lags(p, period_);
        for (const ServoTerm term : {ServoTerm::feedforward, ServoTerm::velocity_step, ServoTerm::friction})
            clamp(term);
        return p;
    }

private:
    ServoParameters lags_;  ///< A, B and C in the places of c, s and f
    double period_;
    ServoMatrix slope_;
};

/// The matrix for a step or a covariance: scaled to a diagonal of 1, inactive terms decoupled.
struct ScaledNormal {
    ServoMatrix matrix;
    ServoVector scale;

    ScaledNormal(const ServoMatrix& normal, const std::array<bool, servo_terms>& active) {
        for (Eigen::Index k = 0; k < scale.size(); ++k) {
            const bool used = active[static_cast<std::size_t>(k)] && normal(k, k) > 0;
            scale[k] = used ? 1 / std::sqrt(normal(k, k)) : 0;
        }
        matrix = scale.asDiagonal() * normal * scale.asDiagonal();
        for (Eigen::Index k = 0; k < scale.size(); ++k) {
            if (scale[k] != 0) continue;
            matrix.row(k).setZero();
            matrix.col(k).setZero();
            matrix(k, k) = 1;
        }
    }
};

constexpr std::array bounded_below{ServoTerm::feedforward, ServoTerm::friction, ServoTerm::backlash,
                                   ServoTerm::dead_time, ServoTerm::integral_step};

/// The parameters after a step. A term at its bound stays there if the step would take it beyond. A term that would cross
/// its bound shortens the whole step, so that it ends at the bound.
ServoParameters stepped(const ServoSolution& at, std::span<const ServoTerm> bounded, double damping, double period) {
    const ServoLags lags(at.parameters, period);
    std::array<bool, servo_terms> active = at.parameters.active;
    for (int round = 0;; ++round) {
        ServoMatrix slope = lags.slope();
        for (std::size_t k = 0; k < servo_terms; ++k) {
            // A fixed term: the coordinates move without it.
            if (!active[k]) slope.row(static_cast<Eigen::Index>(k)).setZero();
        }
        ScaledNormal scaled(slope.transpose() * at.sums.normal * slope, active);
        scaled.matrix.diagonal().array() *= 1 + damping;
        const ServoVector gradient = slope.transpose() * at.sums.gradient;
        const ServoVector step =
            scaled.scale.asDiagonal() * ServoVector(scaled.matrix.ldlt().solve(scaled.scale.asDiagonal() * gradient));
        const ServoVector change = slope * step;
        bool again = false;
        double share = 1;
        for (const ServoTerm term : bounded) {
            const auto k = static_cast<Eigen::Index>(index_of(term));
            const double value = at.parameters[term];
            if (!active[index_of(term)] || !(value + change[k] < 0)) continue;
            if (value <= 0) {
                active[index_of(term)] = false;
                again = true;
            } else {
                share = std::min(share, value / -change[k]);
            }
        }
        if (again && round < static_cast<int>(bounded.size())) continue;
        ServoParameters next = lags.stepped(share * step);
        for (const ServoTerm term : bounded) {
            if (!active[index_of(term)]) next[term] = at.parameters[term];
        }
        return next;
    }
}

/// The recorded commands are also rounded, in phase with the motion: no stated error is smaller than this share
/// (docs/design/identify.md#servo-loops).
constexpr double least_error = 1e-5;

/// The covariance of parameters whose residuals are correlated within groups of records, by the derivatives of `sums`.
ServoMatrix covariance_of(const ServoSolution& at, const ServoSums& sums) {
    const ScaledNormal scaled(sums.normal, at.parameters.active);
    constexpr double ridge = 1e-13;  // terms without any effect get a very large variance
    ServoMatrix inverse = (scaled.matrix + ridge * ServoMatrix::Identity()).inverse();
    inverse = scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
    const ServoMatrix correlated = inverse * sums.scatter * inverse;
    // Rounding may be hidden in residuals of 0, for example at constant speed.
    const ServoMatrix independent = inverse * std::max(sums.mean_square(), at.rounding);
    // Few groups give too small a variance: it is at least that of independent residuals.
    ServoMatrix covariance = correlated;
    for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
        if (correlated(k, k) < independent(k, k)) covariance(k, k) = independent(k, k);
    }
    return covariance;
}

}  // namespace

double ServoSolution::criterion() const {
    const auto n = static_cast<double>(sums.count);
    return n * std::log(sums.mean_square() + 1e-20) + parameters.count() * std::log(n);
}

double ServoSolution::unexplainable() const { return std::max(rounding, sums.variance_of_changes()); }

ServoParameters lags_of_loop(ServoParameters parameters, double period) {
    const double gain = std::exp(parameters[ServoTerm::log_gain]), dead = parameters[ServoTerm::dead_time] * period;
    const auto [alpha, beta] = lags_without_dead_time(parameters, period);
    parameters[ServoTerm::feedforward] = alpha + dead;
    parameters[ServoTerm::velocity_step] = beta - alpha * dead - dead * dead / 2;
    if (parameters.has(ServoTerm::friction))
        parameters[ServoTerm::friction] = parameters[ServoTerm::friction] / gain + parameters[ServoTerm::backlash] / 2;
    return parameters;
}

ServoParameters loop_of_lags(ServoParameters lags, double period) {
    const double gain = std::exp(lags[ServoTerm::log_gain]), dead = lags[ServoTerm::dead_time] * period;
    const double alpha = lags[ServoTerm::feedforward] - dead;
    const double beta = lags[ServoTerm::velocity_step] + alpha * dead + dead * dead / 2;
    const double inverse = 1 + (beta * gain + alpha) / period;
    lags[ServoTerm::feedforward] = 1 - alpha * gain;
    lags[ServoTerm::velocity_step] = inverse > 1 ? 1 / inverse : 1;
    if (lags.has(ServoTerm::friction))
        lags[ServoTerm::friction] = gain * (lags[ServoTerm::friction] - lags[ServoTerm::backlash] / 2);
    return lags;
}

bool settles(const ServoParameters& parameters, double period) {
    const ServoModel model = model_of(parameters, period);
    return model.position_gain * model.velocity_time_constant < 1;
}

ServoSolution minimise(const ServoProblem& problem, const ServoParameters& start, const ServoEffort& effort) {
    constexpr double finer = 0.1, finest = 2e-3, least_width = 1e-6;
    double width = 1;  // of the differences
    ServoSolution at{start, problem.linearise(start, width), {}, 0};
    const auto bounded = std::span(bounded_below).subspan(effort.free_feedforward ? 1 : 0);
    double damping = 1e-4;
    for (int step = 0; step < effort.most_steps; ++step) {
        const ServoParameters next = stepped(at, bounded, damping, problem.period());
        const bool possible = settles(next, problem.period());
        const double squares = possible ? problem.evaluate(next).squares : INFINITY;
        bool arrived = damping > 1e6;
        if (squares < at.sums.squares) {
            arrived = squares > (1 - effort.enough) * at.sums.squares;
            at = {next, problem.linearise(next, width), {}, 0};
            damping = std::max(damping / 10, 1e-9);
        } else {
            damping *= 20;
        }
        if (!arrived) continue;
        // Wide differences give other results only if an axis may stick.
        if (!effort.fine || !at.parameters.has(ServoTerm::friction) || width < finest) break;
        width *= finer;
        damping = 1e-4;
        at.sums = problem.linearise(at.parameters, width);
    }
    if (width < 1) {
        at.fine = {problem.linearise(at.parameters, least_width), problem.linearise(at.parameters, -least_width)};
        at.sums = problem.linearise(at.parameters, 1);
    } else {
        at.fine.fill(at.sums);
    }
    return at;
}

double variance_of(const ServoSolution& at, const ServoVector& weights) {
    double greatest = 0;
    for (const ServoSums* sums : {&at.sums, &at.fine[0], &at.fine[1]}) {
        const ServoMatrix covariance = covariance_of(at, *sums);
        greatest = std::max(greatest, weights.dot(covariance * weights));
    }
    return greatest;
}

std::array<double, servo_terms> standard_errors(const ServoSolution& at) {
    std::array<double, servo_terms> errors{};
    for (std::size_t k = 0; k < servo_terms; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const bool seen = at.parameters.active[k] && at.sums.normal(i, i) > 0;
        const double variance = variance_of(at, ServoVector::Unit(i));
        // Not above 0: the terms are so similar that the inverse is rounding.
        errors[k] = seen && variance > 0 ? std::sqrt(variance) : INFINITY;
        if (static_cast<ServoTerm>(k) <= ServoTerm::velocity_step) errors[k] = std::max(errors[k], least_error);
    }
    return errors;
}

}  // namespace clsurf

#include "identify/servo_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>

#include "identify/servo_start.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

constexpr int dead_periods_searched = 8;
constexpr PointIndex least_records = 200;  ///< that a fit must compare
constexpr double significant = 4;          ///< standard errors
constexpr double least_quantum = 1e-6;     ///< [unit] positions are rounded at least so when a log is written

struct Bounds {
    double low, high;
};

Bounds bounds_of(ServoTerm term, double period) {
    switch (term) {
        case ServoTerm::log_gain: return {std::log(0.1), std::log(0.95 / period)};
        case ServoTerm::feedforward: return {-0.5, 2};  // below 0 by its error only: a bound would hinder the search
        case ServoTerm::velocity_step: return {0.002, 1};
        case ServoTerm::dead_time: return {0, 99};
        case ServoTerm::offset: return {-INFINITY, INFINITY};
        default: return {0, INFINITY};
    }
}

/// A loop that a machine file may describe (io/readers/machine_file.cpp).
bool settles(const ServoParameters& p, double period) {
    const ServoModel model = model_of(p, period);
    return model.position_gain * model.velocity_time_constant < 1;
}

struct Solution {
    ServoParameters parameters;
    ServoSums sums;
    double rounding = 0;  ///< variance of the fed-back positions' rounding [unit²]

    /// Bayesian information criterion of Gaussian residuals. Rounding of doubles explains residuals below 10⁻¹⁰.
    [[nodiscard]] double criterion() const {
        const auto n = static_cast<double>(sums.count);
        return n * std::log(sums.mean_square() + 1e-20) + parameters.count() * std::log(n);
    }
};

/// The matrix that a step or a covariance is solved with: scaled to a diagonal of 1, inactive terms decoupled.
struct ScaledNormal {
    ServoMatrix matrix;
    ServoVector scale;

    ScaledNormal(const ServoMatrix& normal, const ServoParameters& parameters) {
        for (Eigen::Index k = 0; k < scale.size(); ++k) {
            const bool used = parameters.active[static_cast<std::size_t>(k)] && normal(k, k) > 0;
            scale[k] = used ? 1 / std::sqrt(normal(k, k)) : 0;
        }
        matrix = scale.asDiagonal() * normal * scale.asDiagonal();
        for (Eigen::Index k = 0; k < scale.size(); ++k) {
            if (scale[k] == 0) matrix(k, k) = 1;
        }
    }
};

ServoParameters stepped(const Solution& at, double damping, double period) {
    ScaledNormal scaled(at.sums.normal, at.parameters);
    scaled.matrix.diagonal().array() *= 1 + damping;
    const ServoVector step = scaled.scale.asDiagonal() *
                             ServoVector(scaled.matrix.ldlt().solve(scaled.scale.asDiagonal() * at.sums.gradient));
    ServoParameters next = at.parameters;
    for (std::size_t k = 0; k < servo_terms; ++k) {
        if (!next.active[k]) continue;
        const Bounds bounds = bounds_of(static_cast<ServoTerm>(k), period);
        const double change = step[static_cast<Eigen::Index>(k)];
        if (std::isfinite(change)) next.value[k] = std::clamp(next.value[k] + change, bounds.low, bounds.high);
    }
    return next;
}

/// Gauss–Newton with the damping of Levenberg and Marquardt.
Solution minimise(const ServoProblem& problem, const ServoParameters& start) {
    constexpr int most_steps = 25;
    constexpr double enough = 1e-7;  // relative fall of the squares
    Solution at{start, problem.linearise(start), 0};
    double damping = 1e-4;
    for (int step = 0; step < most_steps && damping < 1e8; ++step) {
        const ServoParameters next = stepped(at, damping, problem.period());
        const bool possible = settles(next, problem.period());
        const double squares = possible ? problem.evaluate(next).squares : INFINITY;
        if (!(squares < at.sums.squares)) {
            damping *= 20;
            continue;
        }
        const bool arrived = squares > (1 - enough) * at.sums.squares;
        at = {next, problem.linearise(next), 0};
        damping = std::max(damping / 10, 1e-9);
        if (arrived) break;
    }
    return at;
}

/// The covariance of parameters whose residuals are correlated within groups of records.
ServoMatrix covariance_of(const Solution& at) {
    const ScaledNormal scaled(at.sums.normal, at.parameters);
    constexpr double ridge = 1e-13;  // what is not seen at all gets a variance that says so
    ServoMatrix inverse = (scaled.matrix + ridge * ServoMatrix::Identity()).inverse();
    inverse = scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
    const ServoMatrix correlated = inverse * at.sums.scatter * inverse;
    // Rounding may hide in residuals of nothing, as at constant speed.
    const ServoMatrix independent = inverse * std::max(at.sums.mean_square(), at.rounding);
    // Few groups give too small a variance: never less than that of independent residuals.
    ServoMatrix covariance = correlated;
    for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
        if (correlated(k, k) < independent(k, k)) covariance(k, k) = independent(k, k);
    }
    return covariance;
}

/// The recorded commands are rounded, too, in step with the motion: no error is stated smaller than this share.
constexpr double least_error = 1e-5;

std::array<double, servo_terms> standard_errors(const Solution& at) {
    const ServoMatrix covariance = covariance_of(at);
    std::array<double, servo_terms> errors{};
    for (std::size_t k = 0; k < servo_terms; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const bool seen = at.parameters.active[k] && at.sums.normal(i, i) > 0;
        // Less than 0: the terms are so much alike that the inverse is rounding.
        errors[k] = seen && covariance(i, i) >= 0 ? std::sqrt(covariance(i, i)) : INFINITY;
        if (static_cast<ServoTerm>(k) <= ServoTerm::velocity_step) errors[k] = std::max(errors[k], least_error);
    }
    return errors;
}

/// Where the search for an additional term begins. Friction changes what the other terms seem to be, so the regression,
/// which knows it, is one of the starts.
std::vector<ServoParameters> starts_with(ServoTerm term, const Solution& at, std::span<const ServoStart> regressions) {
    const double along = at.sums.moving > 0 ? std::abs(at.sums.along) / static_cast<double>(at.sums.moving) : 0;
    std::vector<double> values{0.3, 1, 2};  // dead time
    if (term == ServoTerm::backlash) values = {2 * along + 1e-4, 1e-3};
    if (term == ServoTerm::friction) values = {std::exp(at.parameters[ServoTerm::log_gain]) * along + 1e-3, 0.1};
    std::vector<ServoParameters> starts;
    for (const double value : values) {
        starts.push_back(at.parameters);
        starts.back()[term] = value;
    }
    if (term == ServoTerm::friction && !regressions.empty() && regressions.front().friction > 0) {
        ServoParameters start = at.parameters;
        for (const ServoTerm taken : {ServoTerm::log_gain, ServoTerm::feedforward, ServoTerm::velocity_step})
            start[taken] = regressions.front().parameters[taken];
        start[term] = regressions.front().friction;
        starts.push_back(start);
    }
    for (ServoParameters& start : starts) start.active[index_of(term)] = true;
    return starts;
}

/// The same from any loop: the terms that are not in `at` may have made its other values anything. `at` explains nothing of
/// the term, so its residual says how large that may be.
std::vector<ServoParameters> wide_starts_with(ServoTerm term, const Solution& at, double period,
                                              std::span<const ServoStart> regressions) {
    std::vector<ServoParameters> loops{at.parameters, at.parameters};
    const auto take_loop = [&](const ServoParameters& of) {
        for (const ServoTerm taken : {ServoTerm::log_gain, ServoTerm::feedforward, ServoTerm::velocity_step})
            loops.back()[taken] = of[taken];
    };
    take_loop(parameters_of(ServoModel{}, period));
    if (!regressions.empty()) {
        loops.push_back(at.parameters);
        take_loop(regressions.front().parameters);
    }
    const double apart = std::sqrt(at.sums.mean_square());
    std::vector<ServoParameters> starts;
    for (const ServoParameters& loop : loops) {
        const double scale = term == ServoTerm::friction ? std::exp(loop[ServoTerm::log_gain]) * apart : 2 * apart;
        for (const double factor : {0.1, 0.3, 0.6, 1.0, 1.5, 3.0, 10.0}) {
            starts.push_back(loop);
            starts.back()[term] = factor * scale;
            starts.back().active[index_of(term)] = true;
        }
    }
    return starts;
}

/// The best solution from the best `most` of the starts that settle; from the first one where none does.
Solution best_from(const ServoProblem& problem, std::span<const ServoParameters> starts, std::size_t most) {
    std::vector<std::pair<double, ServoParameters>> sorted;
    for (const ServoParameters& start : starts) {
        if (settles(start, problem.period())) sorted.emplace_back(problem.evaluate(start).squares, start);
    }
    if (sorted.empty()) return minimise(problem, starts.front());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Solution best = minimise(problem, sorted.front().second);
    for (std::size_t k = 1; k < std::min(most, sorted.size()); ++k) {
        Solution other = minimise(problem, sorted[k].second);
        if (other.criterion() < best.criterion()) best = std::move(other);
    }
    return best;
}

/// The best solution with another term.
Solution with_term(const ServoProblem& problem, const Solution& base, ServoTerm term,
                   std::span<const ServoStart> regressions) {
    return best_from(problem, starts_with(term, base, regressions), term == ServoTerm::friction ? 2 : 1);
}

/// Adds terms one by one, each time the one that explains most, as long as there is evidence. A term of no certain value that
/// explains more than every other one is added, too: without it another would stand for it.
Solution select_terms(const ServoProblem& problem, Solution base, std::span<const ServoStart> regressions,
                      std::vector<TermEvidence>& evidence) {
    std::vector<ServoTerm> open{ServoTerm::friction, ServoTerm::backlash, ServoTerm::dead_time};
    while (!open.empty()) {
        std::optional<Solution> best;
        bool any_certain = false;
        ServoTerm chosen{};
        std::vector<TermEvidence> tried;
        for (const ServoTerm term : open) {
            if (base.parameters.has(term)) continue;
            const Solution with = with_term(problem, base, term, regressions);
            const double value = with.parameters[term];
            tried.push_back({term, value, base.criterion() - with.criterion(), false});
            if (!(tried.back().gain > 0)) continue;
            any_certain |= value > significant * standard_errors(with)[index_of(term)];
            if (best && with.criterion() >= best->criterion()) continue;
            best = with;
            chosen = term;
        }
        if (!any_certain) {
            evidence.insert(evidence.end(), tried.begin(), tried.end());
            break;
        }
        for (TermEvidence& e : tried) {
            if (e.term != chosen) continue;
            e.kept = true;
            evidence.push_back(e);
        }
        open.erase(std::find(open.begin(), open.end(), chosen));
        base = std::move(*best);
    }
    return base;
}

/// Friction and backlash may hide each other: where the selection has one of them or leaves more than rounding, each is also
/// the first one, from more starts. `rounding`: variance of the fed-back positions [unit²].
Solution select_widely(const ServoProblem& problem, const Solution& base, std::span<const ServoStart> regressions,
                       double rounding, std::vector<TermEvidence>& evidence) {
    Solution best = select_terms(problem, base, regressions, evidence);
    constexpr double most_explained = 2;  // of the variance
    const bool certain = !best.parameters.has(ServoTerm::friction) && !best.parameters.has(ServoTerm::backlash);
    if (certain && best.sums.mean_square() <= most_explained * rounding) return best;
    for (const ServoTerm first : {ServoTerm::friction, ServoTerm::backlash}) {
        if (base.parameters.has(first)) continue;
        Solution with = best_from(problem, wide_starts_with(first, base, problem.period(), regressions), 3);
        const double value = with.parameters[first];
        if (!(value > significant * standard_errors(with)[index_of(first)])) continue;
        std::vector<TermEvidence> found{{first, value, base.criterion() - with.criterion(), true}};
        Solution other = select_terms(problem, std::move(with), regressions, found);
        if (other.criterion() >= best.criterion()) continue;
        best = std::move(other);
        evidence = std::move(found);
    }
    return best;
}

/// Without the terms of no certain value that others have made unnecessary.
Solution without_needless(const ServoProblem& problem, Solution solution, std::vector<TermEvidence>& evidence) {
    for (const ServoTerm term : {ServoTerm::friction, ServoTerm::backlash, ServoTerm::dead_time}) {
        if (!solution.parameters.has(term)) continue;
        if (solution.parameters[term] > significant * standard_errors(solution)[index_of(term)]) continue;
        const double value = solution.parameters[term], before = solution.criterion();
        ServoParameters less = solution.parameters;
        less.value[index_of(term)] = 0;
        less.active[index_of(term)] = false;
        Solution other = minimise(problem, less);
        if (other.criterion() > before) continue;
        solution = std::move(other);
        std::erase_if(evidence, [&](const TermEvidence& e) { return e.term == term; });
        evidence.push_back({term, value, solution.criterion() - before, false});
    }
    return solution;
}

/// The solutions of the best starts of the regression, and of a plain loop in case these are none.
Solution best_of_starts(const ServoProblem& problem, std::vector<ServoStart> starts) {
    if (starts.size() > 2) starts.resize(2);
    starts.push_back({parameters_of(ServoModel{}, problem.period()), 0});
    std::optional<Solution> best;
    for (ServoStart& start : starts) {
        const double dead = start.parameters[ServoTerm::dead_time];
        start.parameters.active[index_of(ServoTerm::dead_time)] = dead > 0;
        Solution solution = minimise(problem, start.parameters);
        // A dead time that the search took back is no part of the loop.
        const std::size_t term = index_of(ServoTerm::dead_time);
        if (dead > 0 && solution.parameters.value[term] < significant * standard_errors(solution)[term]) {
            solution.parameters.value[term] = 0;
            solution.parameters.active[term] = false;
            solution = minimise(problem, solution.parameters);
        }
        if (!best || solution.criterion() < best->criterion()) best = std::move(solution);
    }
    return *best;
}

/// Records until what was before a piece is forgotten.
PointIndex settling_of(const ServoParameters& p, double period) {
    constexpr double time_constants = 25;
    return static_cast<PointIndex>(time_constants / (std::exp(p[ServoTerm::log_gain]) * period)) + 20;
}

bool is_moved(std::span<const AxisRecord> records) {
    for (const AxisRecord& record : records) {
        double low = INFINITY, high = -INFINITY;
        std::vector<double> values;
        for (const PointRange& piece : sample_pieces(record.sections, std::numeric_limits<PointIndex>::max())) {
            values.resize(static_cast<std::size_t>(piece.size()));
            copy_block(record.commanded, piece.first, values);
            const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
            low = std::min(low, *least);
            high = std::max(high, *greatest);
        }
        constexpr double least_move = 0.01;  // mm or deg
        if (high - low > least_move) return true;
    }
    return false;
}

}  // namespace

double ServoFit::time_constant(double period) const { return model_of(parameters, period).velocity_time_constant; }

double ServoFit::time_constant_error(double period) const {
    const double step = parameters[ServoTerm::velocity_step];
    const double error = standard_error[index_of(ServoTerm::velocity_step)];
    // T_v = −T/ln(1 − s). At s = 1 the slope is not bounded: the time constant is below that of the error.
    if (step >= 1) return error < 1 ? -period / std::log(std::min(error, 0.9)) : INFINITY;
    const double logarithm = std::log1p(-step);
    return period * error / (logarithm * logarithm * (1 - step));
}

bool ServoFit::knows(ServoTerm term) const {
    const double error = standard_error[index_of(term)];
    switch (term) {
        case ServoTerm::log_gain: return error < 0.25;
        case ServoTerm::feedforward: return error < 0.1;
        case ServoTerm::velocity_step: return error < 0.25 * parameters[term];
        default: return parameters.has(term) && parameters[term] > significant * error;
    }
}

ServoFit fit_servo(std::span<const AxisRecord> records, double period) {
    ServoFit fit;
    fit.standard_error.fill(INFINITY);
    fit.moves = is_moved(records);
    for (const AxisRecord& record : records) fit.quantum = std::max(fit.quantum, quantum_of(record.feedback));
    ServoProblem problem(records, period, 0);
    if (!fit.moves || problem.count() < least_records) return fit;
    const std::vector<ServoStart> starts = servo_starts(problem, 0);
    const ServoParameters usual = parameters_of(ServoModel{}, period);
    problem.set_settling(settling_of(starts.empty() ? usual : starts.front().parameters, period));
    // At constant speed the regression knows no gain, and may take it for a very low one.
    if (problem.count() < least_records) problem.set_settling(settling_of(usual, period));
    fit.records = problem.count();
    if (fit.records < least_records) return fit;
    const std::vector<ServoStart> regressions = servo_starts(problem, dead_periods_searched);
    const double rounding = std::max(fit.quantum * fit.quantum, least_quantum * least_quantum) / 12;
    Solution solution =
        select_widely(problem, best_of_starts(problem, regressions), regressions, rounding, fit.evidence);
    solution = without_needless(problem, std::move(solution), fit.evidence);
    solution.rounding = rounding;
    fit.parameters = solution.parameters;
    fit.standard_error = standard_errors(solution);
    fit.residual = std::sqrt(solution.sums.mean_square());
    const double between =
        solution.sums.squared_changes / (2 * static_cast<double>(std::max<PointIndex>(fit.records - 1, 1)));
    fit.noise = std::sqrt(std::max(between - fit.quantum * fit.quantum / 12, 0.0));
    const ServoModel model = model_of(fit.parameters, period);
    fit.lag = (1 - model.velocity_feedforward) / model.position_gain + model.dead_time;
    // The lag's own error: of the derivative by feed-forward and gain together.
    const ServoMatrix covariance = covariance_of(solution);
    ServoVector slope = ServoVector::Zero();
    slope[index_of(ServoTerm::log_gain)] = -(1 - model.velocity_feedforward) / model.position_gain;
    slope[index_of(ServoTerm::feedforward)] = -1 / model.position_gain;
    slope[index_of(ServoTerm::dead_time)] = fit.parameters.has(ServoTerm::dead_time) ? period : 0;
    fit.lag_error = std::sqrt(std::max(slope.dot(covariance * slope), 0.0));
    return fit;
}

}  // namespace clsurf

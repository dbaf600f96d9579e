#include "identify/servo_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identify/servo_selection.h"
#include "identify/servo_start.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

constexpr int dead_periods_searched = 8;
constexpr PointIndex least_records = 200;  ///< fewest compared records
constexpr double least_quantum = 1e-6;     ///< [unit] positions in a log are rounded at least to this step
constexpr double least_change = 1e-4;      ///< [unit] least following error without the lag: less is an encoder step

/// Number of records after which the state before a piece has no influence.
PointIndex settling_of(const ServoParameters& p, double period) {
    // e^-25 = 1.4·10^-11 of the state before is left.
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

/// The lag that explains the following error best, as if the speed were constant.
struct ConstantLag {
    double lag = 0, error = 0;  ///< [s]
    double residual = 0;        ///< [unit] rms
};

ConstantLag constant_lag(std::span<const AxisRecord> records, double period) {
    double count = 0, vv = 0, ve = 0, ee = 0;
    std::vector<double> commanded, feedback;
    for (const AxisRecord& record : records) {
        for (const PointRange& piece : sample_pieces(record.sections, std::numeric_limits<PointIndex>::max())) {
            commanded.resize(static_cast<std::size_t>(piece.size()));
            feedback.resize(commanded.size());
            copy_block(record.commanded, piece.first, commanded);
            copy_block(record.feedback, piece.first, feedback);
            for (std::size_t i = 1; i < commanded.size(); ++i) {
                const double speed = (commanded[i] - commanded[i - 1]) / period, error = commanded[i] - feedback[i];
                count += 1;
                vv += speed * speed;
                ve += speed * error;
                ee += error * error;
            }
        }
    }
    if (!(count > 0 && vv > 0)) return {};
    const double residual = std::sqrt(std::max(0.0, ee - ve * ve / vv) / count);
    return {ve / vv, residual / std::sqrt(vv), residual};
}

/// Sets gain and feed-forward from the lag, the only known value.
void take_lag(const ConstantLag& known, double period, ServoFit& fit) {
    ServoModel model;
    model.velocity_feedforward = 1 - known.lag * model.position_gain;
    fit.parameters = parameters_of(model, period);
    fit.lag = known.lag;
    fit.lag_error = known.error;
    fit.residual = known.residual;
    fit.explained = known.residual;
}

}  // namespace

double ServoFit::time_constant(double period) const { return model_of(parameters, period).velocity_time_constant; }

double ServoFit::time_constant_error(double period) const {
    const double step = parameters[ServoTerm::velocity_step];
    const double error = standard_error[index_of(ServoTerm::velocity_step)];
    // T_v = −T/ln(1 − s). At s = 1 the slope is not bounded: the time constant is then below that of the error.
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
        default: return parameters.has(term) && parameters[term] > certain_errors * error;
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
    // With backlash or a dead time the regression may give far too low a gain, whose settling time would leave no records.
    const PointIndex longest_settling = problem.count() / 10;
    problem.set_settling(
        std::min(settling_of(starts.empty() ? usual : starts.front().parameters, period), longest_settling));
    // At constant speed the regression does not determine the gain, and may give a very low one.
    if (problem.count() < least_records) problem.set_settling(settling_of(usual, period));
    fit.records = problem.count();
    if (fit.records < least_records) {
        fit.records = 0;
        return fit;
    }
    // If the speed hardly changes, any loop with that lag explains the records.
    if (const ConstantLag lag = constant_lag(records, period); lag.residual < least_change) {
        take_lag(lag, period, fit);
        return fit;
    }
    const std::vector<ServoStart> regressions = servo_starts(problem, dead_periods_searched);
    const double rounding = std::max(fit.quantum * fit.quantum, least_quantum * least_quantum) / 12;
    SelectedLoop selected = select_loop(problem, regressions, rounding);
    const ServoSolution& solution = selected.solution;
    fit.evidence = std::move(selected.evidence);
    fit.parameters = solution.parameters;
    fit.standard_error = selected.standard_error;
    fit.residual = std::sqrt(solution.sums.mean_square());
    fit.noise = std::sqrt(std::max(solution.sums.variance_of_changes() - fit.quantum * fit.quantum / 12, 0.0));
    fit.explained = std::sqrt(solution.unexplainable());
    const ServoModel model = model_of(fit.parameters, period);
    fit.lag = (1 - model.velocity_feedforward) / model.position_gain + model.dead_time;
    // The standard error of the lag, from its derivatives by feed-forward and gain.
    ServoVector slope = ServoVector::Zero();
    slope[index_of(ServoTerm::log_gain)] = -(1 - model.velocity_feedforward) / model.position_gain;
    slope[index_of(ServoTerm::feedforward)] = -1 / model.position_gain;
    slope[index_of(ServoTerm::dead_time)] = fit.parameters.has(ServoTerm::dead_time) ? period : 0;
    fit.lag_error = std::sqrt(variance_of(solution, slope));
    return fit;
}

}  // namespace clsurf

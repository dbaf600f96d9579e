#include "simulation/plan/speed_problem.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace clsurf {
namespace {

constexpr int most_steps = 90;
constexpr double end_gap = 4e-3;         ///< distance from the optimum, relative to the time, that ends the iteration
constexpr double boundary_share = 0.97;  ///< share of a step to the bound that is taken
// Convergence is best if the slacks say that the start is far from every limit.
constexpr double first_slack = 1.0;  ///< least slack, as a share of the bound
constexpr double first_gap = 1.0;    ///< share of the time
constexpr double diverged = 1e3;     ///< share of the time: a larger gap means that there is no solution
constexpr double mended = 1e-4;      ///< greatest violation, as a share of a bound
constexpr double held = 1 + 3e-4;    ///< share of a limit that counts as kept
constexpr int most_rounds = 6;       ///< each adds rows for limits that the last solution exceeds
constexpr int most_looks = 8;        ///< searches for places between samples at which a solution exceeds a limit
// Rows are also added during the iteration: at a first gap, then whenever the gap has shrunk by a factor, until it is
// small. With a factor of 0.7 instead of 0.3, and multipliers that are kept, 22 to 35 % fewer rows times steps are needed
// (docs/experiments/simulation.md#run-time).
constexpr double early_gap = 0.3, look_step = 0.7, last_look = 0.005;  ///< shares of the time, the gap, the time
constexpr double nearly_held = 0.8;   ///< share of a limit from which a row is added there
constexpr double later_slack = 0.05;  ///< slack of an added row, as a share of its bound

}  // namespace

ProblemLimits<3> linear_limits(const Machine& machine) {
    ProblemLimits<3> limits;
    for (int k = 0; k < 3; ++k) {
        const MachineAxis& axis = machine.axes[static_cast<std::size_t>(k)];
        limits.acceleration[k] = axis.max_acceleration;
        limits.jerk[k] = axis.max_jerk;
    }
    limits.path_acceleration = machine.path.max_acceleration;
    limits.path_jerk = machine.path.max_jerk;
    return limits;
}

ProblemLimits<5> five_axis_limits(const Machine& machine) {
    const ProblemLimits<3> linear = linear_limits(machine);
    ProblemLimits<5> limits;
    limits.acceleration << linear.acceleration, machine.rotary[0].max_acceleration, machine.rotary[1].max_acceleration;
    limits.jerk << linear.jerk, machine.rotary[0].max_jerk, machine.rotary[1].max_jerk;
    limits.path_acceleration = machine.path.max_acceleration;
    limits.path_jerk = machine.path.max_jerk;
    return limits;
}

template <int Axes>
double AxisSpeedProblem<Axes>::value_between(double length, const KnotState& begin, const KnotState& end) {
    const double from_begin = begin.speed * begin.speed + begin.acceleration * length;
    const double from_end = end.speed * end.speed - end.acceleration * length;
    const double low = std::min(begin.speed, end.speed), high = std::max(begin.speed, end.speed);
    return std::clamp(0.5 * (from_begin + from_end), std::max(low * low, 0.01 * high * high), high * high * 1.5);
}

template <int Axes>
void AxisSpeedProblem<Axes>::clear() {
    cells_.clear();
    samples_.clear();
    limiting_.clear();
    value_.assign(1, 0.0);
}

template <int Axes>
void AxisSpeedProblem<Axes>::add_cell(double length, double value, const CellLimits& limits) {
    const auto at = static_cast<std::uint32_t>(samples_.size());
    value_.resize(cells_.size() + 1);  // without the value beyond the end
    Cell cell;
    cell.length = length;
    cell.limits = limits;
    cell.first_sample = cell.end_sample = at;
    cells_.push_back(cell);
    value_.push_back(value);
}

template <int Axes>
void AxisSpeedProblem<Axes>::add_sample(const Sample& sample) {
    samples_.push_back({sample});
    Cell& cell = cells_.back();
    cell.end_sample = static_cast<std::uint32_t>(samples_.size());
    widen(cell, sample);
}

template <int Axes>
void AxisSpeedProblem<Axes>::widen(Cell& cell, const Sample& sample) {
    cell.first = cell.first.cwiseMax(sample.first.cwiseAbs());
    cell.second = cell.second.cwiseMax(sample.second.cwiseAbs());
    cell.third = cell.third.cwiseMax(sample.third.cwiseAbs());
    cell.pace = {std::max(cell.pace.value, sample.pace.value), std::max(cell.pace.slope, std::abs(sample.pace.slope)),
                 std::max(cell.pace.curve, std::abs(sample.pace.curve))};
    cell.least_cap = std::min(cell.least_cap, sample.cap);
}

/// Appends places to the samples of their cells, so that existing rows keep their numbers. False: there are no places.
template <int Axes>
bool AxisSpeedProblem<Axes>::join(const std::vector<Between>& places) {
    if (places.empty()) return false;
    std::vector<HeldSample> joined;
    joined.reserve(samples_.size() + places.size());
    auto place = places.begin();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const auto first = samples_.begin() + static_cast<std::ptrdiff_t>(cell.first_sample),
                   end = samples_.begin() + static_cast<std::ptrdiff_t>(cell.end_sample);
        cell.first_sample = static_cast<std::uint32_t>(joined.size());
        joined.insert(joined.end(), first, end);
        for (; place != places.end() && place->cell == i; ++place) {
            joined.push_back({place->sample, broken_at(place->sample, at_begin(i), 1)});
            widen(cell, place->sample);
            cell.changed = true;
        }
        cell.end_sample = static_cast<std::uint32_t>(joined.size());
    }
    samples_ = std::move(joined);
    return true;
}

template <int Axes>
void AxisSpeedProblem<Axes>::drop_back(std::size_t left) {
    if (left == cells_.size()) return;
    samples_.erase(samples_.begin() + static_cast<std::ptrdiff_t>(cells_[left].first_sample), samples_.end());
    cells_.resize(left);
    value_.resize(left + 1);
    limiting_.resize(std::min(left, limiting_.size()));
}

template <int Axes>
void AxisSpeedProblem<Axes>::drop_front(std::size_t count) {
    if (count == 0) return;
    const std::uint32_t samples = cells_[count - 1].end_sample;
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(samples));
    value_.erase(value_.begin(), value_.begin() + static_cast<std::ptrdiff_t>(count));
    limiting_.erase(limiting_.begin(),
                    limiting_.begin() + static_cast<std::ptrdiff_t>(std::min(count, limiting_.size())));
    for (Cell& cell : cells_) cell.first_sample -= samples, cell.end_sample -= samples;
}

/// Sets the coefficients of the first and last cell, and one beyond each end with equal length, from the states at the
/// ends.
template <int Axes>
void AxisSpeedProblem<Axes>::fix_ends(const KnotState& start, const KnotState& end) {
    const double first = cells_.front().length, last = cells_.back().length;
    const std::size_t n = cells_.size();
    value_.resize(n + 2);
    value_[1] = start.speed * start.speed + start.acceleration * first;
    value_[0] = value_[1] - 2 * start.acceleration * first;
    value_[n] = end.speed * end.speed - end.acceleration * last;
    value_[n + 1] = value_[n] + 2 * end.acceleration * last;
}

/// If a path nearly reverses, a cap is low over a distance that first speeds hardly resolve. b at both ends of such a cell
/// also depends on the coefficients of adjacent cells.
template <int Axes>
void AxisSpeedProblem<Axes>::lower_to_caps() {
    for (std::size_t i = 1; i + 1 < cells_.size(); ++i) {
        const double cap = std::min({cells_[i - 1].limits.cap, cells_[i].limits.cap, cells_[i + 1].limits.cap});
        value_[i + 1] = std::min(value_[i + 1], cap * cap);
    }
}

/// Computes the weights at the starts of all cells.
template <int Axes>
void AxisSpeedProblem<Axes>::weigh() {
    begins_.resize(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double h = cells_[i].length;
        const double before = 1 / ((i > 0 ? cells_[i - 1].length : h) + h),
                     after = 1 / (h + (i + 1 < cells_.size() ? cells_[i + 1].length : h));
        begins_[i] = {{h * before, 1 - h * before, 0},
                      {-2 * before, 2 * before, 0},
                      {2 * before / h, (-2 * after - 2 * before) / h, 2 * after / h}};
    }
}

template <int Axes>
typename AxisSpeedProblem<Axes>::Weights AxisSpeedProblem<Axes>::weights_at(std::size_t cell, double at) const {
    const Weights& begin = begins_[cell];
    Weights w;
    for (std::size_t q = 0; q < 3; ++q) {
        w.b[q] = begin.b[q] + at * (begin.slope[q] + 0.5 * at * begin.curve[q]);
        w.slope[q] = begin.slope[q] + at * begin.curve[q];
    }
    w.curve = begin.curve;
    return w;
}

template <int Axes>
std::array<typename AxisSpeedProblem<Axes>::Weights, 3> AxisSpeedProblem<Axes>::weights_along(std::size_t cell) const {
    const double h = cells_[cell].length;
    return {weights_at(cell, 0), weights_at(cell, 0.5 * h), weights_at(cell, h)};
}

template <int Axes>
double AxisSpeedProblem<Axes>::time() const {
    double sum = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) sum += cells_[i].length / std::sqrt(value_[i + 1]);
    return sum;
}

/// A lower bound of the time [s].
template <int Axes>
double AxisSpeedProblem<Axes>::time_at_caps() const {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.length / cell.limits.cap;
    return sum;
}

/// Adds rows that have become needed; existing rows keep their slacks and multipliers.
template <int Axes>
void AxisSpeedProblem<Axes>::add_needed_rows() {
    std::swap(rows_before_, rows_);
    make_rows(&rows_before_);
    rows_.begin(value_.data(), gap_ / rows_before_.sides(), later_slack, &rows_before_);
}

/// The Newton matrix, and its right side without the barrier.
template <int Axes>
void AxisSpeedProblem<Axes>::assemble() {
    const std::size_t n = cells_.size();
    for (std::vector<double>* part : {&newton_.d0, &newton_.d1, &newton_.d2, &newton_.pull}) part->assign(n + 2, 0);
    for (std::size_t i = 0; i < n; ++i) {
        const double c = value_[i + 1];
        const double gradient = 0.5 * cells_[i].length / (c * std::sqrt(c));
        newton_.pull[i + 1] = gradient;
        newton_.d0[i + 1] = 1.5 * gradient / c;
    }
    const LimitRows::Gap gap = rows_.assemble(value_.data(), newton_);
    gap_ = gap.sum;
    broken_ = gap.broken;
}

/// The diagonals of the free coefficients; those at the ends are known.
template <int Axes>
BandedDiagonals<2> AxisSpeedProblem<Axes>::free_diagonals() {
    const std::size_t first = 2, count = cells_.size() - 2;
    return {std::span(newton_.d0).subspan(first, count), std::span(newton_.d1).subspan(first, count),
            std::span(newton_.d2).subspan(first, count)};
}

/// Replaces the right side in step_ by the solution.
template <int Axes>
void AxisSpeedProblem<Axes>::substitute() {
    solve_banded<2>(free_diagonals(), std::span(step_).subspan(2, cells_.size() - 2));
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}, cells_.size(), cells_.size() + 1}) step_[end] = 0;
}

template <int Axes>
bool AxisSpeedProblem<Axes>::solve(const KnotState& start, const KnotState& end, const LookBetween& look) {
    const std::vector<double> before = value_;
    if (optimise(start, end, look)) return true;
    value_ = before;
    return false;
}

template <int Axes>
bool AxisSpeedProblem<Axes>::optimise(const KnotState& start, const KnotState& end, const LookBetween& look) {
    constexpr std::size_t fewest = 4;
    if (cells_.size() < fewest) return false;
    fix_ends(start, end);
    for (const double c : value_) {
        if (!std::isfinite(c)) return false;
    }
    for (std::size_t i = 1; i + 1 < value_.size(); ++i) {
        if (!(value_[i] > 0)) return false;
    }
    if (first_ == FirstSpeeds::guess) lower_to_caps();
    const double planned = time();
    if (first_ == FirstSpeeds::hold && planned < (1 + end_gap) * time_at_caps()) return false;
    weigh();
    add_likely_rows();
    int looks = 0;
    for (int round = 0; round < most_rounds + looks; ++round) {
        if (round == 0) {
            make_rows();
            rows_.begin(value_.data(), first_gap * time() / rows_.sides(), first_slack);
        } else {
            add_needed_rows();
        }
        if (!iterate() || (first_ == FirstSpeeds::hold && time() > planned)) return false;
        if (add_violated_rows(held)) continue;
        if (look == nullptr || looks == most_looks || !join(look())) {
            limiting_.assign(cells_.size(), Row::cap);
            rows_.judge(value_.data(), limiting_);
            return true;
        }
        ++looks;
    }
    return false;
}

/// Newton steps to the optimum for the present rows. False: it was not found.
template <int Axes>
bool AxisSpeedProblem<Axes>::iterate() {
    double look_at = early_gap;
    for (int k = 0; k < most_steps; ++k) {
        assemble();
        const double gap = gap_ / time();
        if (gap < end_gap && broken_ < mended) return true;
        if (!(gap < diverged)) return false;
        if (gap < look_at) {
            // While slacks are large, rows can be added without a restart.
            look_at = gap > last_look ? look_step * gap : 0;
            if (add_violated_rows(nearly_held)) {
                add_needed_rows();
                assemble();
            }
        }
        if (!step()) return false;
    }
    return broken_ < mended;
}

template <int Axes>
bool AxisSpeedProblem<Axes>::step() {
    if (!factorise_banded<2>(free_diagonals())) return false;
    step_ = newton_.pull;
    substitute();
    const auto taken = [](double most) { return std::min(1.0, boundary_share / most); };
    newton_.centring.assign(value_.size(), 0);
    newton_.products.assign(value_.size(), 0);
    const LimitRows::Steps predicted = rows_.predict(step_.data(), newton_);
    const double primal = taken(predicted.primal), dual = taken(predicted.dual);
    const double left =
        gap_ + primal * predicted.by_primal + dual * predicted.by_dual + primal * dual * predicted.by_both;
    constexpr double least_centre = 1e-3;
    const double centre = std::clamp(left / gap_, least_centre, 1.0) * gap_ / rows_.sides();
    for (std::size_t i = 0; i < step_.size(); ++i)
        step_[i] = newton_.pull[i] + centre * newton_.centring[i] - newton_.products[i];
    substitute();
    const LimitRows::Steps corrected = rows_.correct(step_.data(), centre);
    if (!std::isfinite(corrected.primal) || !std::isfinite(corrected.dual)) return false;
    const double forward = taken(corrected.primal);
    for (std::size_t i = 0; i < step_.size(); ++i) value_[i] += forward * step_[i];
    rows_.advance(forward, taken(corrected.dual));
    return true;
}

template class AxisSpeedProblem<3>;
template class AxisSpeedProblem<5>;

}  // namespace clsurf

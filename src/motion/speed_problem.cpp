#include "motion/speed_problem.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr int most_steps = 90;
constexpr double end_gap = 4e-3;         ///< of the time: how far from the optimum it stops
constexpr double boundary_share = 0.97;  ///< of the way to a limit in one step
// A start far from every limit, as its slacks say, converges best.
constexpr double first_slack = 1.0;      ///< of a bound, at least
// Where a limit is broken, standing still mends it too, as J/√b grows: b may not fall to that.
constexpr double least_share = 0.2;      ///< of a coefficient, of what it began with
constexpr double first_gap = 1.0;        ///< of the time
constexpr double mended = 1e-4;          ///< of a bound
// The spline holds the limits at stations; a little is left for what lies between them.
constexpr double acceleration_share = 0.9995, jerk_share = 0.997;
constexpr double held = 1 + 3e-4;
constexpr double lowering = 0.998;  ///< of a limit that is broken between its rows, besides
constexpr double early_gap = 0.3, nearly_held = 0.8;
constexpr double later_slack = 0.05;
constexpr int most_rounds = 6;
constexpr double last_look = 0.02, look_step = 0.3;
// Rows are left out until the solution without them breaks them. In from the beginning is what comes near its limit
// with the speeds to begin with, or could with some more speed and acceleration.
constexpr double near_limit = 0.6;
constexpr double faster = 1.1, steeper = 0.15;

using Three = std::array<double, 3>;

double dot(const Three& w, const double* c) { return w[0] * c[0] + w[1] * c[1] + w[2] * c[2]; }

Three sum(double a, const Three& u, double b, const Three& v) { return {a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]}; }

constexpr std::uint8_t acceleration_bit(int axis) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(axis)); }
constexpr std::uint8_t jerk_bit(int axis) { return static_cast<std::uint8_t>(8U << static_cast<unsigned>(axis)); }

}  // namespace

double SpeedProblem::value_between(double length, const KnotState& begin, const KnotState& end) {
    const double from_begin = begin.speed * begin.speed + begin.acceleration * length;
    const double from_end = end.speed * end.speed - end.acceleration * length;
    const double low = std::min(begin.speed, end.speed), high = std::max(begin.speed, end.speed);
    return std::clamp(0.5 * (from_begin + from_end), std::max(low * low, 0.01 * high * high), high * high * 1.5);
}

void SpeedProblem::clear() {
    cells_.clear();
    stations_.clear();
    ruling_.clear();
    value_.assign(1, 0.0);
}

void SpeedProblem::add_cell(double length, double value, const CellLimits& limits) {
    const auto at = static_cast<std::uint32_t>(stations_.size());
    value_.resize(cells_.size() + 1);  // without the one beyond the end
    Cell cell;
    cell.length = length;
    cell.limits = limits;
    cell.first_station = cell.end_station = at;
    cells_.push_back(cell);
    value_.push_back(value);
}

void SpeedProblem::add_station(const Station& station) {
    stations_.push_back({station});
    Cell& cell = cells_.back();
    cell.end_station = static_cast<std::uint32_t>(stations_.size());
    cell.slope = cell.slope.cwiseMax(station.slope.cwiseAbs());
    cell.bend = cell.bend.cwiseMax(station.bend.cwiseAbs());
    cell.twist = cell.twist.cwiseMax(station.twist.cwiseAbs());
}

void SpeedProblem::drop_front(std::size_t count) {
    if (count == 0) return;
    const std::uint32_t stations = cells_[count - 1].end_station;
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    stations_.erase(stations_.begin(), stations_.begin() + static_cast<std::ptrdiff_t>(stations));
    value_.erase(value_.begin(), value_.begin() + static_cast<std::ptrdiff_t>(count));
    ruling_.erase(ruling_.begin(), ruling_.begin() + static_cast<std::ptrdiff_t>(std::min(count, ruling_.size())));
    for (Cell& cell : cells_) cell.first_station -= stations, cell.end_station -= stations;
}

/// The states at the ends set the first and last cell, and one beyond, as long, that gives b there.
void SpeedProblem::fix_ends(const KnotState& start, const KnotState& end) {
    const double first = cells_.front().length, last = cells_.back().length;
    const std::size_t n = cells_.size();
    value_.resize(n + 2);
    value_[1] = start.speed * start.speed + start.acceleration * first;
    value_[0] = value_[1] - 2 * start.acceleration * first;
    value_[n] = end.speed * end.speed - end.acceleration * last;
    value_[n + 1] = value_[n] + 2 * end.acceleration * last;
}

/// The weights at the begins of all cells.
void SpeedProblem::weigh() {
    begins_.resize(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double h = cells_[i].length;
        const double before = 1 / ((i > 0 ? cells_[i - 1].length : h) + h), after = 1 / (h + (i + 1 < cells_.size() ? cells_[i + 1].length : h));
        begins_[i] = {{h * before, 1 - h * before, 0}, {-2 * before, 2 * before, 0}, {2 * before / h, (-2 * after - 2 * before) / h, 2 * after / h}};
    }
}

SpeedProblem::Weights SpeedProblem::weights_at(std::size_t cell, double at) const {
    const Weights& begin = begins_[cell];
    Weights w;
    for (std::size_t q = 0; q < 3; ++q) {
        w.b[q] = begin.b[q] + at * (begin.slope[q] + 0.5 * at * begin.curve[q]);
        w.slope[q] = begin.slope[q] + at * begin.curve[q];
    }
    w.curve = begin.curve;
    return w;
}

std::array<SpeedProblem::Weights, 3> SpeedProblem::weights_along(std::size_t cell) const {
    const double h = cells_[cell].length;
    return {weights_at(cell, 0), weights_at(cell, 0.5 * h), weights_at(cell, h)};
}

/// Whether an axis may be above a part of a limit at a station of a cell where v², acceleration and jerk along the path are at most these.
bool SpeedProblem::may_break(const Cell& cell, double part, double acceleration, double square, double jerk) const {
    const double speed = std::sqrt(square);
    for (int x = 0; x < 3; ++x) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(x)];
        if (cell.slope[x] * acceleration + cell.bend[x] * square > part * axis.max_acceleration) return true;
        if (axis.max_jerk > 0 && cell.slope[x] * jerk + speed * (3 * cell.bend[x] * acceleration + cell.twist[x] * square) > part * axis.max_jerk) return true;
    }
    return false;
}

/// Rows for what may come to its limit, judged by the values to begin with.
void SpeedProblem::need_likely_rows() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const double* c = &value_[i];
        const std::array<Weights, 3> along = weights_along(i);
        std::size_t fastest = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (dot(along[k].b, c) > dot(along[fastest].b, c)) fastest = k;
        }
        const double b = dot(along[fastest].b, c);
        cell.jerk[fastest] = true;  // its bound is least there
        const double acceleration = 0.5 * std::max(std::abs(dot(along[0].slope, c)), std::abs(dot(along[2].slope, c)));
        if (acceleration > near_limit * cell.limits.acceleration) cell.acceleration = true;
        const double speed = std::min(faster * std::sqrt(b), cell.limits.cap);
        const double steep = std::max(acceleration, steeper * cell.limits.acceleration);
        if (!may_break(cell, 1, steep, speed * speed, cell.limits.jerk)) continue;
        for (std::uint32_t s = cell.first_station; s < cell.end_station; ++s) {
            HeldStation& held_station = stations_[s];
            const Station& station = held_station.station;
            for (int x = 0; x < 3; ++x) {
                const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(x)];
                const double slope = std::abs(station.slope[x]), bend = std::abs(station.bend[x]), twist = std::abs(station.twist[x]);
                if (slope * steep + bend * speed * speed > axis.max_acceleration) held_station.needed |= acceleration_bit(x);
                if (axis.max_jerk <= 0) continue;
                if (slope * cell.limits.jerk + speed * (3 * bend * steep + twist * speed * speed) > axis.max_jerk) held_station.needed |= jerk_bit(x);
            }
        }
    }
}

/// Rows for what is above a part of its limit and has none; false: nothing is.
bool SpeedProblem::need_broken_rows(double part) {
    bool any = false;
    const auto need = [&](bool& row) { any = any || !row, row = true; };
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const double* c = &value_[i];
        const Weights& begin = begins_[i];
        const double b = dot(begin.b, c), curve = dot(begin.curve, c), slope = dot(begin.slope, c);
        const double last_slope = slope + cell.length * curve, last = b + 0.5 * cell.length * (slope + last_slope);
        if (0.5 * std::abs(last_slope) > part * cell.limits.acceleration) need(cell.acceleration);
        // The tangential jerk is greatest where the speed is: at an end, or where b turns over.
        double fastest = slope + 0.5 * cell.length * curve > 0 ? cell.length : 0;
        if (slope > 0 && last_slope < 0) fastest = -slope / curve;
        const double greatest = std::max({b, last, b + fastest * (slope + 0.5 * fastest * curve)});
        const double along_path = std::abs(0.5 * curve) * std::sqrt(greatest);
        if (along_path > part * cell.limits.jerk) {
            bool& row = cell.jerk[static_cast<std::size_t>(std::lround(2 * fastest / cell.length))];
            if (!row) {
                need(row);
            } else if (part >= 1) {  // between the rows
                cell.jerk_share *= lowering * cell.limits.jerk / along_path;
                any = true;
            }
        }
        if (!may_break(cell, part, 0.5 * std::max(std::abs(slope), std::abs(last_slope)), greatest, along_path)) continue;
        for (std::uint32_t s = cell.first_station; s < cell.end_station; ++s) {
            HeldStation& held_station = stations_[s];
            const Station& station = held_station.station;
            const double b_here = b + station.at * (slope + 0.5 * station.at * curve);
            const double slope_here = slope + station.at * curve;
            const double root = std::sqrt(b_here);
            std::uint8_t broken = 0;
            for (int x = 0; x < 3; ++x) {
                const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(x)];
                const double acceleration = std::abs(0.5 * station.slope[x] * slope_here + station.bend[x] * b_here);
                if (acceleration > part * axis.max_acceleration) broken |= acceleration_bit(x);
                if (axis.max_jerk <= 0) continue;
                const double jerk = std::abs(0.5 * station.slope[x] * curve + 1.5 * station.bend[x] * slope_here + station.twist[x] * b_here) * root;
                if (jerk > part * axis.max_jerk) broken |= jerk_bit(x);
            }
            any = any || (broken & ~held_station.needed) != 0;
            held_station.needed |= broken;
        }
    }
    return any;
}

void SpeedProblem::add_cap(std::uint32_t number, std::size_t cell, const Three& weights, double cap) {
    const double share = 1 / (cap * cap);
    LimitRow row;
    row.w = {weights[0] * share, weights[1] * share, weights[2] * share};
    row.low = -least_share * dot(row.w, &value_[cell]);
    row.cell = static_cast<std::uint32_t>(cell);
    row.number = number;
    rows_.add(row);
}

void SpeedProblem::add_row(std::uint32_t number, Row kind, std::size_t cell, const Three& w, double limit) {
    rows_.add({{w[0] / limit, w[1] / limit, w[2] / limit}, {}, 1, 1, static_cast<std::uint32_t>(cell), number, kind});
}

void SpeedProblem::add_jerk(std::uint32_t number, Row kind, std::size_t cell, const Three& w, const Three& b, double limit) {
    rows_.add({{w[0] / limit, w[1] / limit, w[2] / limit}, b, 0, 1, static_cast<std::uint32_t>(cell), number, kind});
}

void SpeedProblem::make_rows() {
    rows_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const bool last_cell = i + 1 == cells_.size();
        const std::array<Weights, 3> along = weights_along(i);
        const Weights& last = along[2];
        // A cell's b lies below the greatest of its coefficient and b at its ends (they are its Bézier points).
        if (i > 0 && !last_cell) add_cap(0, i, {0, 1, 0}, cell.limits.cap);
        if (!last_cell) {
            const CellLimits& next = cells_[i + 1].limits;
            add_cap(1, i, last.b, std::min(cell.limits.cap, next.cap));
            if (cell.acceleration) add_row(2, Row::tangential_acceleration, i, sum(0.5, last.slope, 0, last.slope), acceleration_share * std::min(cell.limits.acceleration, next.acceleration));
        }
        const double jerk = jerk_share * cell.jerk_share * cell.limits.jerk;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (cell.jerk[k]) add_jerk(3 + k, Row::tangential_jerk, i, sum(0.5, along[k].curve, 0, along[k].curve), along[k].b, jerk);
        }
        for (std::uint32_t s = cell.first_station; s < cell.end_station; ++s) {
            if (stations_[s].needed == 0) continue;
            const Station& station = stations_[s].station;
            const Weights w = weights_at(i, station.at);
            for (int x = 0; x < 3; ++x) {
                const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(x)];
                const std::uint32_t number = 6 + 6 * (s - cell.first_station) + 2 * static_cast<std::uint32_t>(x);
                if ((stations_[s].needed & acceleration_bit(x)) != 0) {
                    add_row(number, Row::axis_acceleration, i, sum(0.5 * station.slope[x], w.slope, station.bend[x], w.b), acceleration_share * axis.max_acceleration);
                }
                if ((stations_[s].needed & jerk_bit(x)) != 0) {
                    const double limit = jerk_share * axis.max_jerk;
                    const double steady = std::abs(station.twist[x]) * cell.limits.cap * cell.limits.cap * cell.limits.cap;
                    const Three moving = sum(1.5 * station.bend[x], w.slope, station.twist[x], w.b);
                    add_jerk(number + 1, steady > 0.5 * limit ? Row::corner_jerk : Row::axis_jerk, i, sum(0.5 * station.slope[x], w.curve, 1, moving), w.b, limit);
                }
            }
        }
    }
}

double SpeedProblem::time() const {
    double sum = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) sum += cells_[i].length / std::sqrt(value_[i + 1]);
    return sum;
}

/// No speeds take less [s].
double SpeedProblem::time_at_caps() const {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.length / cell.limits.cap;
    return sum;
}

/// Rows that have become needed, beside those that are there with what they are in the middle of.
void SpeedProblem::add_needed_rows() {
    std::swap(rows_before_, rows_);
    make_rows();
    rows_.begin(value_.data(), gap_ / rows_before_.sides(), later_slack, &rows_before_);
}

/// The Newton matrix, and its right side but for the barrier.
void SpeedProblem::assemble() {
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

/// L D Lᵀ of the five diagonals in place; the coefficients at the ends are known.
bool SpeedProblem::factorise() {
    const std::size_t first = 2, last = cells_.size() - 1;
    for (std::size_t i = first; i <= last; ++i) {
        if (!(newton_.d0[i] > 0) || !std::isfinite(newton_.d0[i])) return false;
        newton_.d0[i] = 1 / newton_.d0[i];
        const double l1 = newton_.d1[i] * newton_.d0[i], l2 = newton_.d2[i] * newton_.d0[i];
        if (i + 1 <= last) {
            newton_.d0[i + 1] -= l1 * newton_.d1[i];
            newton_.d1[i + 1] -= l1 * newton_.d2[i];
        }
        if (i + 2 <= last) newton_.d0[i + 2] -= l2 * newton_.d2[i];
        newton_.d1[i] = l1;
        newton_.d2[i] = l2;
    }
    return true;
}

/// step_ becomes the solution for the right side that is in it.
void SpeedProblem::substitute() {
    const std::size_t first = 2, last = cells_.size() - 1;
    for (std::size_t i = first; i <= last; ++i) {
        if (i + 1 <= last) step_[i + 1] -= newton_.d1[i] * step_[i];
        if (i + 2 <= last) step_[i + 2] -= newton_.d2[i] * step_[i];
    }
    for (std::size_t i = last + 1; i-- > first;) {
        step_[i] *= newton_.d0[i];
        if (i + 1 <= last) step_[i] -= newton_.d1[i] * step_[i + 1];
        if (i + 2 <= last) step_[i] -= newton_.d2[i] * step_[i + 2];
    }
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}, cells_.size(), cells_.size() + 1}) step_[end] = 0;
}

bool SpeedProblem::solve(const KnotState& start, const KnotState& end) {
    const std::vector<double> before = value_;
    if (optimise(start, end)) return true;
    value_ = before;
    return false;
}

bool SpeedProblem::optimise(const KnotState& start, const KnotState& end) {
    constexpr std::size_t fewest = 4;
    if (cells_.size() < fewest) return false;
    fix_ends(start, end);
    for (const double c : value_) {
        if (!std::isfinite(c)) return false;
    }
    for (std::size_t i = 1; i + 1 < value_.size(); ++i) {
        if (!(value_[i] > 0)) return false;
    }
    const double planned = time();
    if (planned < (1 + end_gap) * time_at_caps()) return false;
    weigh();
    need_likely_rows();
    for (int round = 0; round < most_rounds; ++round) {
        make_rows();
        rows_.begin(value_.data(), first_gap * time() / rows_.sides(), first_slack);
        if (!iterate() || time() > planned) return false;
        if (!need_broken_rows(held)) {
            ruling_.assign(cells_.size(), Row::cap);
            rows_.judge(value_.data(), ruling_);
            return true;
        }
    }
    return false;
}

/// Newton's steps to the optimum for the rows; false: it was not found.
bool SpeedProblem::iterate() {
    double look_at = early_gap;
    for (int k = 0; k < most_steps; ++k) {
        assemble();
        const double gap = gap_ / time();
        if (gap < end_gap && broken_ < mended) return true;
        if (gap < look_at) {
            // While slacks are large, rows can join without ado.
            look_at = gap > last_look ? look_step * gap : 0;
            if (need_broken_rows(nearly_held)) {
                add_needed_rows();
                assemble();
            }
        }
        if (!step()) return false;
    }
    return broken_ < mended;
}

bool SpeedProblem::step() {
    if (!factorise()) return false;
    step_ = newton_.pull;
    substitute();
    const auto taken = [](double most) { return std::min(1.0, boundary_share / most); };
    newton_.centring.assign(value_.size(), 0);
    newton_.products.assign(value_.size(), 0);
    const LimitRows::Steps predicted = rows_.predict(step_.data(), newton_);
    const double primal = taken(predicted.primal), dual = taken(predicted.dual);
    const double left = gap_ + primal * predicted.by_primal + dual * predicted.by_dual + primal * dual * predicted.by_both;
    constexpr double least_centre = 1e-3;
    const double centre = std::clamp(left / gap_, least_centre, 1.0) * gap_ / rows_.sides();
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = newton_.pull[i] + centre * newton_.centring[i] - newton_.products[i];
    substitute();
    const LimitRows::Steps corrected = rows_.correct(step_.data(), centre);
    if (!std::isfinite(corrected.primal) || !std::isfinite(corrected.dual)) return false;
    const double forward = taken(corrected.primal);
    for (std::size_t i = 0; i < step_.size(); ++i) value_[i] += forward * step_[i];
    rows_.advance(forward, taken(corrected.dual));
    return true;
}

}  // namespace clsurf

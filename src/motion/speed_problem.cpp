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
constexpr double faster = 1.2, steeper = 0.3;

using Three = std::array<double, 3>;

double dot(const Three& w, const double* c) { return w[0] * c[0] + w[1] * c[1] + w[2] * c[2]; }

Three sum(double a, const Three& u, double b, const Three& v) { return {a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]}; }

constexpr std::uint8_t acceleration_bit(int axis) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(axis)); }
constexpr std::uint8_t jerk_bit(int axis) { return static_cast<std::uint8_t>(8U << static_cast<unsigned>(axis)); }

/// Weights below to above: the sides' signs.
const Eigen::Array2d signs(-1, 1);

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
    cells_.back().end_station = static_cast<std::uint32_t>(stations_.size());
}

void SpeedProblem::drop_front(std::size_t count) {
    if (count == 0) return;
    const std::uint32_t stations = cells_[count - 1].end_station;
    cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(count));
    stations_.erase(stations_.begin(), stations_.begin() + static_cast<std::ptrdiff_t>(stations));
    value_.erase(value_.begin(), value_.begin() + static_cast<std::ptrdiff_t>(count));
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

SpeedProblem::Weights SpeedProblem::weights_at(std::size_t cell, double at) const {
    const double h = cells_[cell].length;
    const double h_before = cell > 0 ? cells_[cell - 1].length : h;
    const double h_after = cell + 1 < cells_.size() ? cells_[cell + 1].length : h;
    const double before = 1 / (h_before + h), after = 1 / (h + h_after);
    const Three begin{h * before, h_before * before, 0};
    const Three begin_slope{-2 * before, 2 * before, 0};
    Weights w{{}, {}, {2 * before / h, (-2 * after - 2 * before) / h, 2 * after / h}};
    for (std::size_t q = 0; q < 3; ++q) {
        w.b[q] = begin[q] + at * (begin_slope[q] + 0.5 * at * w.curve[q]);
        w.slope[q] = begin_slope[q] + at * w.curve[q];
    }
    return w;
}

std::array<SpeedProblem::Weights, 3> SpeedProblem::weights_along(std::size_t cell) const {
    const double h = cells_[cell].length;
    return {weights_at(cell, 0), weights_at(cell, 0.5 * h), weights_at(cell, h)};
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
        const std::array<Weights, 3> along = weights_along(i);
        const double b = dot(along[0].b, c), curve = dot(along[0].curve, c), slope = dot(along[0].slope, c);
        if (std::abs(0.5 * dot(along[2].slope, c)) > part * cell.limits.acceleration) need(cell.acceleration);
        // The tangential jerk is greatest where the speed is: at an end, or where b turns over.
        double fastest = slope + 0.5 * cell.length * curve > 0 ? cell.length : 0;
        if (slope > 0 && slope + cell.length * curve < 0) fastest = -slope / curve;
        const double along_path = std::abs(0.5 * curve) * std::sqrt(b + fastest * (slope + 0.5 * fastest * curve));
        if (along_path > part * cell.limits.jerk) {
            bool& row = cell.jerk[static_cast<std::size_t>(std::lround(2 * fastest / cell.length))];
            if (!row) {
                need(row);
            } else if (part >= 1) {  // between the rows
                cell.jerk_share *= lowering * cell.limits.jerk / along_path;
                any = true;
            }
        }
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
    Limit row;
    row.w = {weights[0] * share, weights[1] * share, weights[2] * share};
    row.low = -least_share * dot(row.w, &value_[cell]);
    row.cell = static_cast<std::uint32_t>(cell);
    row.number = number;
    rows_.push_back(row);
}

void SpeedProblem::add_row(std::uint32_t number, Row kind, std::size_t cell, const Three& w, double limit) {
    Limit row;
    row.w = {w[0] / limit, w[1] / limit, w[2] / limit};
    row.kind = kind;
    row.cell = static_cast<std::uint32_t>(cell);
    row.number = number;
    rows_.push_back(row);
}

void SpeedProblem::add_jerk(std::uint32_t number, Row kind, std::size_t cell, const Three& w, const Three& b, double limit) {
    add_row(number, kind, cell, w, limit);
    rows_.back().v = b;
    rows_.back().unit = 0;
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
        cell.end_row = static_cast<std::uint32_t>(rows_.size());
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

/// Slacks of at least a part of the bound, and multipliers for a product of `centre`.
void SpeedProblem::begin(Limit& row, double centre, double slack) const {
    row.follow(&value_[row.cell]);
    row.slack = row.left().max(slack * row.bound);
    if (row.kind == Row::cap) row.slack[1] = row.left()[1];
    row.multiplier = centre * row.slack.inverse();
    row.slack_step.setZero();
    row.multiplier_step.setZero();
}

/// Rows that have become needed, beside those that are there with what they are in the middle of.
void SpeedProblem::add_needed_rows() {
    rows_before_.swap(rows_);
    const double centre = gap_ / static_cast<double>(2 * rows_before_.size());
    make_rows();
    std::size_t before = 0;
    for (Limit& row : rows_) {
        if (before < rows_before_.size() && rows_before_[before].cell == row.cell && rows_before_[before].number == row.number) row = rows_before_[before++];
        else begin(row, centre, later_slack);
    }
}

/// Takes parts of the steps.
void SpeedProblem::advance(double primal, double dual) {
    for (std::size_t i = 0; i < step_.size(); ++i) value_[i] += primal * step_[i];
    for (Limit& row : rows_) {
        row.slack += primal * row.slack_step;
        row.multiplier += dual * row.multiplier_step;
    }
}

/// The Newton matrix, and its right side but for the barrier.
void SpeedProblem::assemble() {
    const std::size_t n = cells_.size();
    d0_.assign(n + 2, 0);
    d1_.assign(n + 2, 0);
    d2_.assign(n + 2, 0);
    pull_.assign(n + 2, 0);
    for (std::size_t i = 0; i < n; ++i) {
        const double c = value_[i + 1];
        const double gradient = 0.5 * cells_[i].length / (c * std::sqrt(c));
        pull_[i + 1] = gradient;
        d0_[i + 1] = 1.5 * gradient / c;
    }
    gap_ = broken_ = 0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < n; ++k) {
        double d00 = 0, d11 = 0, d22 = 0, d01 = 0, d12 = 0, d02 = 0;
        Three pull{};
        for (; at < cells_[k].end_row; ++at) {
            Limit& row = rows_[at];
            const Three& w = row.w;
            const Three& v = row.v;
            row.follow(&value_[k]);
            // A bound that is convex leaves more than its tangent did.
            const Sides left = row.left();
            row.slack = row.slack.max(left);
            row.inverse = row.slack.inverse();
            const Sides weight = row.multiplier * row.inverse;
            gap_ += (row.multiplier * row.slack).sum();
            const Sides missing = row.slack - left;
            broken_ = std::max(broken_, missing.maxCoeff() * row.root);
            const Sides force = weight * missing;
            const double of_w = force[1] - force[0], both = weight.sum();
            if (row.unit > 0) {
                pull = sum(1, pull, of_w, w);
                d00 += both * w[0] * w[0];
                d11 += both * w[1] * w[1];
                d22 += both * w[2] * w[2];
                d01 += both * w[0] * w[1];
                d12 += both * w[1] * w[2];
                d02 += both * w[0] * w[2];
                continue;
            }
            // The sides' gradients are fall v ∓ w.
            const double of_b = row.fall * force.sum();
            const double mixed = row.fall * (weight[1] - weight[0]), square = row.fall * row.fall * both;
            const Three u = sum(both, w, mixed, v), t = sum(mixed, w, square, v);
            pull = sum(1, pull, 1, sum(of_w, w, of_b, v));
            d00 += u[0] * w[0] + t[0] * v[0];
            d11 += u[1] * w[1] + t[1] * v[1];
            d22 += u[2] * w[2] + t[2] * v[2];
            d01 += u[0] * w[1] + t[0] * v[1];
            d12 += u[1] * w[2] + t[1] * v[2];
            d02 += u[0] * w[2] + t[0] * v[2];
        }
        d0_[k] += d00;
        d0_[k + 1] += d11;
        d0_[k + 2] += d22;
        d1_[k] += d01;
        d1_[k + 1] += d12;
        d2_[k] += d02;
        for (std::size_t q = 0; q < 3; ++q) pull_[k + q] += pull[q];
    }
}

/// L D Lᵀ of the five diagonals in place; the coefficients at the ends are known.
bool SpeedProblem::factorise() {
    const std::size_t first = 2, last = cells_.size() - 1;
    for (std::size_t i = first; i <= last; ++i) {
        if (!(d0_[i] > 0) || !std::isfinite(d0_[i])) return false;
        d0_[i] = 1 / d0_[i];
        const double l1 = d1_[i] * d0_[i], l2 = d2_[i] * d0_[i];
        if (i + 1 <= last) {
            d0_[i + 1] -= l1 * d1_[i];
            d1_[i + 1] -= l1 * d2_[i];
        }
        if (i + 2 <= last) d0_[i + 2] -= l2 * d2_[i];
        d1_[i] = l1;
        d2_[i] = l2;
    }
    return true;
}

/// step_ becomes the solution for the right side that is in it.
void SpeedProblem::substitute() {
    const std::size_t first = 2, last = cells_.size() - 1;
    for (std::size_t i = first; i <= last; ++i) {
        if (i + 1 <= last) step_[i + 1] -= d1_[i] * step_[i];
        if (i + 2 <= last) step_[i + 2] -= d2_[i] * step_[i];
    }
    for (std::size_t i = last + 1; i-- > first;) {
        step_[i] *= d0_[i];
        if (i + 1 <= last) step_[i] -= d1_[i] * step_[i + 1];
        if (i + 2 <= last) step_[i] -= d2_[i] * step_[i + 2];
    }
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}, cells_.size(), cells_.size() + 1}) step_[end] = 0;
}

/// Steps of slacks and multipliers without a barrier, and the right sides that the corrector needs of them.
SpeedProblem::Steps SpeedProblem::predict() {
    centring_.assign(value_.size(), 0);
    products_.assign(value_.size(), 0);
    Steps steps;
    Sides primal = Sides::Zero(), dual = Sides::Zero(), by_primal = Sides::Zero(), by_dual = Sides::Zero(), by_both = Sides::Zero();
    std::size_t at = 0;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        const double* s = &step_[k];
        Three centring{}, products{};
        for (; at < cells_[k].end_row; ++at) {
            Limit& row = rows_[at];
            row.slack_step = row.left() - row.slack + (signs * dot(row.w, s) + row.fall * dot(row.v, s));
            const Sides part = row.slack_step * row.inverse;
            row.multiplier_step = -row.multiplier * (part + 1);
            primal = primal.max(-part);
            dual = dual.max(part + 1);
            by_primal += row.slack_step * row.multiplier;
            by_dual += row.slack * row.multiplier_step;
            const Sides product = row.slack_step * row.multiplier_step;
            by_both += product;
            const Sides weighted = product * row.inverse;
            centring = sum(1, centring, 1, sum(row.inverse[1] - row.inverse[0], row.w, row.fall * row.inverse.sum(), row.v));
            products = sum(1, products, 1, sum(weighted[1] - weighted[0], row.w, row.fall * weighted.sum(), row.v));
        }
        for (std::size_t q = 0; q < 3; ++q) {
            centring_[k + q] += centring[q];
            products_[k + q] += products[q];
        }
    }
    return {primal.maxCoeff(), dual.maxCoeff(), by_primal.sum(), by_dual.sum(), by_both.sum()};
}

/// Steps towards `centre`, corrected by the products of those before (Mehrotra 1992).
SpeedProblem::Steps SpeedProblem::correct(double centre) {
    Sides primal = Sides::Zero(), dual = Sides::Zero();
    for (Limit& row : rows_) {
        const double* s = &step_[row.cell];
        const Sides product = row.slack_step * row.multiplier_step;
        row.slack_step = row.left() - row.slack + (signs * dot(row.w, s) + row.fall * dot(row.v, s));
        row.multiplier_step = (centre - product - row.multiplier * row.slack_step) * row.inverse - row.multiplier;
        primal = primal.max(-row.slack_step * row.inverse);
        dual = dual.max(-row.multiplier_step / row.multiplier);
    }
    return {primal.maxCoeff(), dual.maxCoeff()};
}

/// Which limit each cell is nearest to.
void SpeedProblem::judge() {
    std::vector<double> nearest(cells_.size(), 0);
    for (Limit& row : rows_) {
        row.follow(&value_[row.cell]);
        const double part = std::abs(row.value) * row.root;
        if (part > nearest[row.cell]) {
            nearest[row.cell] = part;
            cells_[row.cell].ruling = row.kind;
        }
    }
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
    need_likely_rows();
    for (int round = 0; round < most_rounds; ++round) {
        make_rows();
        const double centre = first_gap * time() / static_cast<double>(2 * rows_.size());
        for (Limit& row : rows_) begin(row, centre, first_slack);
        if (!iterate() || time() > planned) return false;
        if (!need_broken_rows(held)) {
            judge();
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
    step_ = pull_;
    substitute();
    const auto taken = [](double most) { return std::min(1.0, boundary_share / most); };
    const Steps predicted = predict();
    const double primal = taken(predicted.primal), dual = taken(predicted.dual);
    const double left = gap_ + primal * predicted.by_primal + dual * predicted.by_dual + primal * dual * predicted.by_both;
    constexpr double least_centre = 1e-3;
    const double centre = std::clamp(left / gap_, least_centre, 1.0) * gap_ / static_cast<double>(2 * rows_.size());
    for (std::size_t i = 0; i < step_.size(); ++i) step_[i] = pull_[i] + centre * centring_[i] - products_[i];
    substitute();
    const Steps corrected = correct(centre);
    if (!std::isfinite(corrected.primal) || !std::isfinite(corrected.dual)) return false;
    advance(taken(corrected.primal), taken(corrected.dual));
    return true;
}

}  // namespace clsurf

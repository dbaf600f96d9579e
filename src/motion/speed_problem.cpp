#include "motion/speed_problem.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

constexpr int most_steps = 45;
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
constexpr double lowering = 0.998;
constexpr int most_rounds = 4;

double dot(const double* w, const double* c) { return w[0] * c[0] + w[1] * c[1] + w[2] * c[2]; }

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

void SpeedProblem::add_cell(double length, double value) {
    const auto at = static_cast<std::uint32_t>(stations_.size());
    value_.resize(cells_.size() + 1);  // without the one beyond the end
    Cell cell;
    cell.length = length;
    cell.first_station = cell.end_station = at;
    cells_.push_back(cell);
    value_.push_back(value);
}

void SpeedProblem::add_station(const Station& station) {
    stations_.push_back(station);
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
    const double begin[3] = {h * before, h_before * before, 0};
    const double begin_slope[3] = {-2 * before, 2 * before, 0};
    Weights w{{}, {}, {2 * before / h, (-2 * after - 2 * before) / h, 2 * after / h}};
    for (int q = 0; q < 3; ++q) {
        w.b[q] = begin[q] + at * (begin_slope[q] + 0.5 * at * w.curve[q]);
        w.slope[q] = begin_slope[q] + at * w.curve[q];
    }
    return w;
}

void SpeedProblem::make_rows() {
    places_.clear();
    limits_.clear();
    kinds_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const Cell& cell = cells_[i];
        for (std::uint32_t s = cell.first_station; s < cell.end_station; ++s) {
            const Station& station = stations_[s];
            if (station.checked) continue;
            const Weights w = weights_at(i, station.at);
            Place place;
            place.cell = static_cast<std::uint32_t>(i);
            place.first = static_cast<std::uint32_t>(limits_.size());
            for (int q = 0; q < 3; ++q) place.b[q] = w.b[q];
            const auto add = [&](Row kind, double of_curve, double of_slope, double of_b, double limit) {
                Limit row{};
                for (int q = 0; q < 3; ++q) row.w[q] = (of_curve * w.curve[q] + of_slope * w.slope[q] + of_b * w.b[q]) / limit;
                limits_.push_back(row);
                kinds_.push_back(kind);
            };
            const double v = station.cap;
            const double share = acceleration_share * cell.acceleration_share;
            add(Row::cap, 0, 0, 1, v * v);
            if (!station.between) add(Row::tangential_acceleration, 0, 0.5, 0, station.acceleration * share);
            for (int x = 0; station.bent && x < 3; ++x) {
                const double limit = machine_->axes[static_cast<std::size_t>(x)].max_acceleration * share;
                if (std::abs(station.slope[x]) * station.acceleration + std::abs(station.bend[x]) * v * v > limit) {
                    add(Row::axis_acceleration, 0, 0.5 * station.slope[x], station.bend[x], limit);
                }
            }
            place.jerks = static_cast<std::uint32_t>(limits_.size());
            if (!station.between || !station.bent) add(Row::tangential_jerk, 0.5, 0, 0, station.jerk * jerk_share * cell.jerk_share);
            for (int x = 0; station.bent && x < 3; ++x) {
                const double limit = machine_->axes[static_cast<std::size_t>(x)].max_jerk * jerk_share * cell.jerk_share;
                if (limit <= 0) continue;
                const double ramp = std::abs(station.slope[x]) * station.jerk + 3 * std::abs(station.bend[x]) * v * station.acceleration;
                const double steady = std::abs(station.twist[x]) * v * v * v;
                if (ramp + steady > limit) {
                    add(steady > 0.5 * limit ? Row::corner_jerk : Row::axis_jerk, 0.5 * station.slope[x], 1.5 * station.bend[x], station.twist[x], limit);
                }
            }
            place.end = static_cast<std::uint32_t>(limits_.size());
            places_.push_back(place);
        }
    }
}

/// Greatest part of a limit of an axis at a station: of the acceleration, and of the jerk.
double SpeedProblem::exceeding(const Station& s, const double* c, const Weights& w, double& jerk) const {
    const double b = dot(w.b, c), slope = dot(w.slope, c), curve = dot(w.curve, c);
    const double root = std::sqrt(b);
    double acceleration = 0;
    jerk = 0;
    for (int x = 0; x < 3; ++x) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(x)];
        acceleration = std::max(acceleration, std::abs(0.5 * s.slope[x] * slope + s.bend[x] * b) / axis.max_acceleration);
        if (axis.max_jerk <= 0) continue;
        jerk = std::max(jerk, std::abs(0.5 * s.slope[x] * curve + 1.5 * s.bend[x] * slope + s.twist[x] * b) * root / axis.max_jerk);
    }
    return acceleration;
}

/// Where limits are broken between stations the cell gets less of them; false: nowhere.
bool SpeedProblem::lower_shares() {
    bool any = false;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        double acceleration = 0, jerk = 0;
        for (std::uint32_t s = cell.first_station; s < cell.end_station; ++s) {
            if (!stations_[s].bent) continue;
            double here = 0;
            acceleration = std::max(acceleration, exceeding(stations_[s], &value_[i], weights_at(i, stations_[s].at), here));
            jerk = std::max(jerk, here);
        }
        // With a little more than what was found: the next solution differs.
        if (acceleration > held) cell.acceleration_share *= lowering / acceleration, any = true;
        if (jerk > held) cell.jerk_share *= lowering / jerk, any = true;
    }
    return any;
}

double SpeedProblem::time() const {
    double sum = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) sum += cells_[i].length / std::sqrt(value_[i + 1]);
    return sum;
}

/// body(place, row, bound, fall): g = bound ∓ w · c; its gradient is fall · place.b ∓ w.
template <typename Body>
void SpeedProblem::for_each_row(Body&& body) {
    for (const Place& p : places_) {
        const double* c = &value_[p.cell];
        for (std::uint32_t k = p.first; k < p.jerks; ++k) body(p, limits_[k], 1.0, 0.0);
        const double b = p.b[0] * c[0] + p.b[1] * c[1] + p.b[2] * c[2];
        const double root = 1 / std::sqrt(b);
        const double fall = -0.5 * root / b;
        for (std::uint32_t k = p.jerks; k < p.end; ++k) body(p, limits_[k], root, fall);
    }
}

void SpeedProblem::begin() {
    sides_ = static_cast<double>(2 * limits_.size() + value_.size());
    const double centre = first_gap * time() / sides_;
    floor_ = value_;
    above_.resize(value_.size());
    for (std::size_t i = 0; i < value_.size(); ++i) {
        floor_[i] = value_[i] - (1 - least_share) * std::abs(value_[i]);
        const double above = std::max(value_[i] - floor_[i], 1e-300);
        above_[i].slack = above;
        above_[i].multiplier = centre / above;
    }
    for_each_row([&](const Place& p, Limit& row, double bound, double) {
        const double r = dot(row.w, &value_[p.cell]);
        row.high.slack = std::max(bound - r, first_slack * bound);
        row.low.slack = std::max(bound + r, first_slack * bound);
        row.high.multiplier = centre / row.high.slack;
        row.low.multiplier = centre / row.low.slack;
    });
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
    for (std::size_t i = 0; i < above_.size(); ++i) {
        Side& side = above_[i];
        side.inverse = 1 / side.slack;
        d0_[i] += side.multiplier * side.inverse;
        gap_ += side.slack * side.multiplier;
    }
    const auto add = [&](const Place& p, Side& side, double g, double bound, double v0, double v1, double v2) {
        side.inverse = 1 / side.slack;
        const double weight = side.multiplier * side.inverse;
        gap_ += side.multiplier * side.slack;
        const double missing = side.slack - g;
        broken_ = std::max(broken_, missing / bound);
        const double force = weight * missing;
        const std::size_t k = p.cell;
        pull_[k] += force * v0;
        pull_[k + 1] += force * v1;
        pull_[k + 2] += force * v2;
        d0_[k] += weight * v0 * v0;
        d0_[k + 1] += weight * v1 * v1;
        d0_[k + 2] += weight * v2 * v2;
        d1_[k] += weight * v0 * v1;
        d1_[k + 1] += weight * v1 * v2;
        d2_[k] += weight * v0 * v2;
    };
    for_each_row([&](const Place& p, Limit& row, double bound, double fall) {
        const double r = dot(row.w, &value_[p.cell]);
        add(p, row.high, bound - r, bound, fall * p.b[0] - row.w[0], fall * p.b[1] - row.w[1], fall * p.b[2] - row.w[2]);
        add(p, row.low, bound + r, bound, fall * p.b[0] + row.w[0], fall * p.b[1] + row.w[1], fall * p.b[2] + row.w[2]);
    });
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

/// Steps of slacks and multipliers that go with step_; `corrected`: for the products of the steps before.
void SpeedProblem::set_steps(bool corrected) {
    for_each_row([&](const Place& p, Limit& row, double bound, double fall) {
        const double* s = &step_[p.cell];
        const double r = dot(row.w, &value_[p.cell]);
        const double dr = dot(row.w, s);
        const double db = fall * dot(p.b, s);
        set_step(row.high, bound - r, db - dr, corrected);
        set_step(row.low, bound + r, db + dr, corrected);
    });
    for (std::size_t i = 0; i < above_.size(); ++i) set_step(above_[i], above_[i].slack, step_[i], corrected);
}

void SpeedProblem::set_step(Side& side, double g, double change, bool corrected) const {
    const double product = corrected ? side.slack_step * side.multiplier_step : 0.0;
    side.slack_step = g - side.slack + change;
    side.multiplier_step = (centre_ - product - side.multiplier * side.slack_step) * side.inverse - side.multiplier;
}

/// Right side of the corrector: Mehrotra's, with the products of the predictor's steps.
void SpeedProblem::correct(double centre) {
    centre_ = centre;
    step_ = pull_;
    for (std::size_t i = 0; i < above_.size(); ++i) {
        step_[i] += (centre - above_[i].slack_step * above_[i].multiplier_step) * above_[i].inverse;
    }
    for_each_row([&](const Place& p, Limit& row, double, double fall) {
        const double high = (centre - row.high.slack_step * row.high.multiplier_step) * row.high.inverse;
        const double low = (centre - row.low.slack_step * row.low.multiplier_step) * row.low.inverse;
        for (int q = 0; q < 3; ++q) step_[p.cell + static_cast<std::size_t>(q)] += (high + low) * fall * p.b[q] + (low - high) * row.w[q];
    });
}

void SpeedProblem::longest_steps(double& primal, double& dual) const {
    primal = dual = 1 / boundary_share;
    const auto shorten = [&](const Side& side) {
        if (side.slack + primal * side.slack_step < 0) primal = -side.slack / side.slack_step;
        if (side.multiplier + dual * side.multiplier_step < 0) dual = -side.multiplier / side.multiplier_step;
    };
    for (const Side& side : above_) shorten(side);
    for (const Limit& row : limits_) {
        shorten(row.high);
        shorten(row.low);
    }
    primal *= boundary_share;
    dual *= boundary_share;
}

double SpeedProblem::gap_after(double primal, double dual) const {
    double gap = 0;
    const auto add = [&](const Side& side) {
        gap += (side.slack + primal * side.slack_step) * (side.multiplier + dual * side.multiplier_step);
    };
    for (const Side& side : above_) add(side);
    for (const Limit& row : limits_) {
        add(row.high);
        add(row.low);
    }
    return gap;
}

void SpeedProblem::advance(double primal, double dual) {
    for (std::size_t i = 0; i < step_.size(); ++i) {
        value_[i] += primal * step_[i];
        above_[i].slack += primal * above_[i].slack_step;
        above_[i].multiplier += dual * above_[i].multiplier_step;
    }
    for_each_row([&](const Place& p, Limit& row, double bound, double) {
        const double r = dot(row.w, &value_[p.cell]);
        const auto move = [&](Side& side, double g) {
            side.multiplier += dual * side.multiplier_step;
            // A bound that is convex leaves more than its tangent did.
            side.slack = std::max(side.slack + primal * side.slack_step, g);
        };
        move(row.high, bound - r);
        move(row.low, bound + r);
    });
}

/// Which limit each cell is nearest to.
void SpeedProblem::judge() {
    std::vector<double> nearest(cells_.size(), 0);
    for (const Place& p : places_) {
        const double* c = &value_[p.cell];
        const double root = std::sqrt(dot(p.b, c));
        for (std::uint32_t k = p.first; k < p.end; ++k) {
            const double part = std::abs(dot(limits_[k].w, c)) * (k < p.jerks ? 1.0 : root);
            if (part > nearest[p.cell]) {
                nearest[p.cell] = part;
                cells_[p.cell].ruling = kinds_[k];
            }
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
    for (int round = 0; round < most_rounds; ++round) {
        make_rows();
        if (!iterate() || time() > planned) return false;
        if (!lower_shares()) {
            judge();
            return true;
        }
    }
    return false;
}

/// Newton's steps to the optimum for the rows; false: it was not found.
bool SpeedProblem::iterate() {
    begin();
    for (int k = 0; k < most_steps; ++k) {
        assemble();
        if (gap_ < end_gap * time() && broken_ < mended) return true;
        if (!step()) return false;
    }
    return broken_ < mended;
}

bool SpeedProblem::step() {
    if (!factorise()) return false;
    centre_ = 0;
    step_ = pull_;
    substitute();
    set_steps(false);
    double primal = 0, dual = 0;
    longest_steps(primal, dual);
    const double left = gap_after(primal, dual) / gap_;
    constexpr double least_centre = 1e-3;
    correct(std::clamp(left, least_centre, 1.0) * gap_ / sides_);
    substitute();
    set_steps(true);
    longest_steps(primal, dual);
    if (!std::isfinite(primal) || !std::isfinite(dual)) return false;
    advance(primal, dual);
    return true;
}

}  // namespace clsurf

// Which limits of a SpeedProblem become rows, and the rows. A limit is left out until a solution without it exceeds it.

#include <algorithm>
#include <cmath>

#include "simulation/plan/speed_problem.h"

namespace clsurf {
namespace {

// An exceeded limit could also be satisfied at standstill, as J/√b grows: this bound keeps b away from 0.
constexpr double least_coefficient = 0.2;  ///< share of the first value of a coefficient
// The spline satisfies the limits at samples; a margin is left for the places between them.
constexpr double acceleration_share = 0.9995, jerk_share = 0.997;
// With 0.9995, one of 14,000 random programs exceeded the acceleration along the path by 0.2 %.
constexpr double path_acceleration_share = 0.998;  ///< on a rounded path, whose pace varies fast on sharp bends
constexpr double lowering = 0.998;                 ///< additional factor for a limit that is exceeded between its rows
// Rows from the beginning: limits that are nearly reached at the first speeds, or could be at somewhat more speed and
// acceleration.
constexpr double near_limit = 0.6;
constexpr double faster = 1.1, steeper = 0.15;
constexpr double path_likely = 0.85;  ///< share of the jerk along the path; the rest is for its rounding

using Three = std::array<double, 3>;

double dot(const Three& w, const double* c) { return w[0] * c[0] + w[1] * c[1] + w[2] * c[2]; }

Three sum(double a, const Three& u, double b, const Three& v) {
    return {a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]};
}

constexpr std::uint16_t acceleration_bit(int axis) {
    return static_cast<std::uint16_t>(1U << static_cast<unsigned>(axis));
}
template <int Axes>
constexpr std::uint16_t jerk_bit(int axis) {
    return acceleration_bit(Axes + axis);
}
template <int Axes>
constexpr std::uint16_t path_bit = acceleration_bit(2 * Axes);
template <int Axes>
constexpr std::uint16_t path_jerk_bit = acceleration_bit(2 * Axes + 1);
template <int Axes>
constexpr std::uint16_t speed_bit = acceleration_bit(2 * Axes + 2);
template <int Axes>
constexpr std::uint32_t rows_of_sample = 2 * Axes + 3;

}  // namespace

/// Whether an axis or the path may exceed a share of a limit at a sample of a cell. v², acceleration and jerk are upper
/// bounds.
template <int Axes>
bool AxisSpeedProblem<Axes>::may_break(const Cell& cell, double part, double acceleration, double square, double jerk,
                                       double path_jerk) const {
    const double limit = part * limits_.path_acceleration;
    if (cell.pace.value * acceleration + cell.pace.slope * square > limit) return true;
    const double speed = std::sqrt(square);
    if (square > part * cell.least_cap * cell.least_cap) return true;
    if (cell.pace.value * path_jerk + speed * (3 * cell.pace.slope * acceleration + cell.pace.curve * square) >
        part * limits_.path_jerk)
        return true;
    for (int x = 0; x < Axes; ++x) {
        if (cell.first[x] * acceleration + cell.second[x] * square > part * limits_.acceleration[x]) return true;
        if (limits_.jerk[x] > 0 &&
            cell.first[x] * jerk + speed * (3 * cell.second[x] * acceleration + cell.third[x] * square) >
                part * limits_.jerk[x])
            return true;
    }
    return false;
}

/// The tangential acceleration allowed at the end of a cell, which is also the start of the next one.
template <int Axes>
double AxisSpeedProblem<Axes>::acceleration_at_end(std::size_t cell) const {
    const double here = cells_[cell].limits.acceleration;
    return cell + 1 < cells_.size() ? std::min(here, cells_[cell + 1].limits.acceleration) : here;
}

/// Marks rows for limits that are likely to be reached, judged by the first values.
template <int Axes>
void AxisSpeedProblem<Axes>::add_likely_rows() {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const double* c = &value_[i];
        const std::array<Weights, 3> along = weights_along(i);
        std::size_t fastest = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (dot(along[k].b, c) > dot(along[fastest].b, c)) fastest = k;
        }
        const double b = dot(along[fastest].b, c);
        cell.jerk[fastest] = std::isfinite(cell.limits.jerk);  // its bound is lowest there
        const double acceleration = 0.5 * std::max(std::abs(dot(along[0].slope, c)), std::abs(dot(along[2].slope, c)));
        if (acceleration > near_limit * acceleration_at_end(i)) cell.acceleration = true;
        const double speed = std::min(faster * std::sqrt(b), cell.limits.cap);
        const double steep =
            std::max(acceleration, steeper * std::min(cell.limits.acceleration, limits_.path_acceleration));
        const double jerk = std::min(cell.limits.jerk, limits_.path_jerk);
        if (!std::isfinite(cell.limits.jerk))  // one sample is enough: they hardly differ if the path is hardly rounded
            samples_[(cell.first_sample + cell.end_sample) / 2].needed |= path_jerk_bit<Axes>;
        if (!may_break(cell, 1, steep, speed * speed, jerk, path_likely * jerk)) continue;
        for (std::uint32_t s = cell.first_sample; s < cell.end_sample; ++s) {
            HeldSample& held_sample = samples_[s];
            const Sample& sample = held_sample.sample;
            if (sample.pace.value * steep + std::abs(sample.pace.slope) * speed * speed > limits_.path_acceleration)
                held_sample.needed |= path_bit<Axes>;
            if (sample.pace.value * path_likely * jerk +
                    speed * (3 * std::abs(sample.pace.slope) * steep + std::abs(sample.pace.curve) * speed * speed) >
                limits_.path_jerk)
                held_sample.needed |= path_jerk_bit<Axes>;
            if (speed > sample.cap) held_sample.needed |= speed_bit<Axes>;
            for (int x = 0; x < Axes; ++x) {
                const double first = std::abs(sample.first[x]), second = std::abs(sample.second[x]),
                             third = std::abs(sample.third[x]);
                if (first * steep + second * speed * speed > limits_.acceleration[x])
                    held_sample.needed |= acceleration_bit(x);
                if (limits_.jerk[x] <= 0) continue;
                if (first * jerk + speed * (3 * second * steep + third * speed * speed) > limits_.jerk[x])
                    held_sample.needed |= jerk_bit<Axes>(x);
            }
        }
    }
}

template <int Axes>
typename AxisSpeedProblem<Axes>::AtBegin AxisSpeedProblem<Axes>::at_begin(std::size_t cell) const {
    const double* c = &value_[cell];
    const Weights& begin = begins_[cell];
    return {dot(begin.b, c), dot(begin.slope, c), dot(begin.curve, c)};
}

/// The magnitudes of the limited quantities at a sample of a cell.
template <int Axes>
struct AxisSpeedProblem<Axes>::SampleMotion {
    const Sample& sample;
    double curve, slope, b, root;  ///< of b = v² there, and its square root

    SampleMotion(const Sample& at_sample, const AtBegin& at)
        : sample(at_sample),
          curve(at.curve),
          slope(at.slope + sample.at * curve),
          b(at.b + sample.at * (at.slope + 0.5 * sample.at * curve)),
          root(std::sqrt(b)) {}

    [[nodiscard]] double path_acceleration() const {
        return std::abs(0.5 * sample.pace.value * slope + sample.pace.slope * b);
    }
    [[nodiscard]] double path_jerk() const {
        return std::abs(0.5 * sample.pace.value * curve + 1.5 * sample.pace.slope * slope + sample.pace.curve * b) *
               root;
    }
    [[nodiscard]] double acceleration(int x) const {
        return std::abs(0.5 * sample.first[x] * slope + sample.second[x] * b);
    }
    [[nodiscard]] double jerk(int x) const {
        return std::abs(0.5 * sample.first[x] * curve + 1.5 * sample.second[x] * slope + sample.third[x] * b) * root;
    }
};

/// The limits that are used by more than a share at a sample of a cell, as bits of HeldSample::needed.
template <int Axes>
std::uint16_t AxisSpeedProblem<Axes>::broken_at(const Sample& sample, const AtBegin& at, double part) const {
    const SampleMotion motion(sample, at);
    std::uint16_t broken = 0;
    if (motion.path_acceleration() > part * limits_.path_acceleration) broken |= path_bit<Axes>;
    if (motion.path_jerk() > part * limits_.path_jerk) broken |= path_jerk_bit<Axes>;
    if (motion.b > part * sample.cap * sample.cap) broken |= speed_bit<Axes>;
    for (int x = 0; x < Axes; ++x) {
        if (motion.acceleration(x) > part * limits_.acceleration[x]) broken |= acceleration_bit(x);
        if (limits_.jerk[x] > 0 && motion.jerk(x) > part * limits_.jerk[x]) broken |= jerk_bit<Axes>(x);
    }
    return broken;
}

template <int Axes>
double AxisSpeedProblem<Axes>::greatest_share(std::size_t cell, const Sample& sample) const {
    const SampleMotion motion(sample, at_begin(cell));
    double share = std::max({motion.path_acceleration() / limits_.path_acceleration,
                             motion.path_jerk() / limits_.path_jerk, motion.b / (sample.cap * sample.cap)});
    for (int x = 0; x < Axes; ++x) {
        share = std::max(share, motion.acceleration(x) / limits_.acceleration[x]);
        if (limits_.jerk[x] > 0) share = std::max(share, motion.jerk(x) / limits_.jerk[x]);
    }
    return share;
}

template <int Axes>
double AxisSpeedProblem<Axes>::holding_share(const KnotState& start, const KnotState& end) {
    fix_ends(start, end);
    weigh();
    double share = 1;
    const auto limit_square = [&](double square, double cap) { share = std::min(share, cap * cap / square); };
    const auto limit_acceleration = [&](double acceleration, double limit) {
        share = std::min(share, limit / acceleration);
    };
    const auto limit_jerk = [&](double jerk, double limit) {  // multiplying v² by s multiplies a jerk by s √s
        if (limit > 0 && limit < jerk) share = std::min(share, std::pow(limit / jerk, 2.0 / 3));
    };
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const Cell& cell = cells_[i];
        const AtBegin at = at_begin(i);
        const double last_slope = at.slope + cell.length * at.curve;
        const double last = at.b + 0.5 * cell.length * (at.slope + last_slope);
        const double greatest = std::max({at.b, last, value_[i + 1]});
        limit_square(greatest, cell.limits.cap);
        limit_acceleration(std::abs(0.5 * last_slope), acceleration_at_end(i));
        limit_jerk(std::abs(0.5 * at.curve) * std::sqrt(greatest), cell.limits.jerk);
        for (std::uint32_t k = cell.first_sample; k < cell.end_sample; ++k) {
            const SampleMotion motion(samples_[k].sample, at);
            limit_square(motion.b, motion.sample.cap);
            limit_acceleration(motion.path_acceleration(), limits_.path_acceleration);
            limit_jerk(motion.path_jerk(), limits_.path_jerk);
            for (int x = 0; x < Axes; ++x) {
                limit_acceleration(motion.acceleration(x), limits_.acceleration[x]);
                limit_jerk(motion.jerk(x), limits_.jerk[x]);
            }
        }
    }
    return share;
}

template <int Axes>
void AxisSpeedProblem<Axes>::scale(double factor) {
    for (double& value : value_) value *= factor;
    limiting_.assign(cells_.size(), Row::axis_jerk);
}

/// Marks rows for limits that have no rows and are used by more than a share. False: there are none.
template <int Axes>
bool AxisSpeedProblem<Axes>::add_violated_rows(double part) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        const auto use = [&](bool& row) { cell.changed = cell.changed || !row, row = true; };
        const double* c = &value_[i];
        const Weights& begin = begins_[i];
        const double b = dot(begin.b, c), curve = dot(begin.curve, c), slope = dot(begin.slope, c);
        const double last_slope = slope + cell.length * curve, last = b + 0.5 * cell.length * (slope + last_slope);
        if (0.5 * std::abs(last_slope) > part * acceleration_at_end(i)) use(cell.acceleration);
        // The tangential jerk is greatest where the speed is: at an end, or at the maximum of b.
        double fastest = slope + 0.5 * cell.length * curve > 0 ? cell.length : 0;
        if (slope > 0 && last_slope < 0) fastest = -slope / curve;
        const double greatest = std::max({b, last, b + fastest * (slope + 0.5 * fastest * curve)});
        const double along_path = std::abs(0.5 * curve) * std::sqrt(greatest);
        if (along_path > part * cell.limits.jerk) {
            bool& row = cell.jerk[static_cast<std::size_t>(std::lround(2 * fastest / cell.length))];
            if (!row) {
                use(row);
            } else if (part >= 1) {  // between the rows
                cell.jerk_share *= lowering * cell.limits.jerk / along_path;
                cell.changed = true;
            }
        }
        if (!may_break(cell, part, 0.5 * std::max(std::abs(slope), std::abs(last_slope)), greatest, along_path,
                       along_path))
            continue;
        for (std::uint32_t s = cell.first_sample; s < cell.end_sample; ++s) {
            HeldSample& held_sample = samples_[s];
            const std::uint16_t broken = broken_at(held_sample.sample, {b, slope, curve}, part);
            cell.changed = cell.changed || (broken & ~held_sample.needed) != 0;
            held_sample.needed |= broken;
        }
    }
    return std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.changed; });
}

template <int Axes>
void AxisSpeedProblem<Axes>::add_cap(std::uint32_t number, std::size_t cell, const Three& weights, double cap) {
    const double share = 1 / (cap * cap);
    LimitRow row;
    row.w = {weights[0] * share, weights[1] * share, weights[2] * share};
    row.low = -least_coefficient * dot(row.w, &value_[cell]);
    row.cell = static_cast<std::uint32_t>(cell);
    row.number = number;
    rows_.add(row);
}

template <int Axes>
void AxisSpeedProblem<Axes>::add_row(std::uint32_t number, Row kind, std::size_t cell, const Three& w, double limit) {
    rows_.add({{w[0] / limit, w[1] / limit, w[2] / limit}, {}, 1, 1, static_cast<std::uint32_t>(cell), number, kind});
}

template <int Axes>
void AxisSpeedProblem<Axes>::add_jerk(std::uint32_t number, Row kind, std::size_t cell, const Three& w, const Three& b,
                                      double limit) {
    rows_.add({{w[0] / limit, w[1] / limit, w[2] / limit}, b, 0, 1, static_cast<std::uint32_t>(cell), number, kind});
}

/// Makes all rows. With `before`, the rows of unchanged cells are taken from there with their slacks and multipliers.
template <int Axes>
void AxisSpeedProblem<Axes>::make_rows(const LimitRows* before) {
    rows_.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (before != nullptr && !cells_[i].changed) {
            rows_.keep(*before, static_cast<std::uint32_t>(i));
        } else {
            make_rows_of(i);
            cells_[i].changed = false;
        }
    }
}

template <int Axes>
void AxisSpeedProblem<Axes>::make_rows_of(std::size_t i) {
    const Cell& cell = cells_[i];
    const bool last_cell = i + 1 == cells_.size();
    const std::array<Weights, 3> along = weights_along(i);
    const Weights& last = along[2];
    // A cell's b is at most the greatest of its coefficient and b at its ends (its Bézier points).
    if (i > 0 && !last_cell) add_cap(0, i, {0, 1, 0}, cell.limits.cap);
    if (!last_cell) {
        const CellLimits& next = cells_[i + 1].limits;
        add_cap(1, i, last.b, std::min(cell.limits.cap, next.cap));
        if (cell.acceleration)
            add_row(2, Row::tangential_acceleration, i, sum(0.5, last.slope, 0, last.slope),
                    acceleration_share * acceleration_at_end(i));
    }
    const double jerk = jerk_share * cell.jerk_share * cell.limits.jerk;
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (cell.jerk[k])
            add_jerk(3 + k, Row::tangential_jerk, i, sum(0.5, along[k].curve, 0, along[k].curve), along[k].b, jerk);
    }
    for (std::uint32_t s = cell.first_sample; s < cell.end_sample; ++s) {
        if (samples_[s].needed == 0) continue;
        const Sample& sample = samples_[s].sample;
        const Weights w = weights_at(i, sample.at);
        const std::uint32_t first = 6 + rows_of_sample<Axes> * (s - cell.first_sample);
        for (int x = 0; x < Axes; ++x) {
            const std::uint32_t number = first + 2 * static_cast<std::uint32_t>(x);
            if ((samples_[s].needed & acceleration_bit(x)) != 0) {
                add_row(number, Row::axis_acceleration, i, sum(0.5 * sample.first[x], w.slope, sample.second[x], w.b),
                        acceleration_share * limits_.acceleration[x]);
            }
            if ((samples_[s].needed & jerk_bit<Axes>(x)) != 0) {
                const double limit = jerk_share * limits_.jerk[x];
                const double steady = std::abs(sample.third[x]) * cell.limits.cap * cell.limits.cap * cell.limits.cap;
                const Three moving = sum(1.5 * sample.second[x], w.slope, sample.third[x], w.b);
                add_jerk(number + 1, steady > 0.5 * limit ? Row::bend_jerk : Row::axis_jerk, i,
                         sum(0.5 * sample.first[x], w.curve, 1, moving), w.b, limit);
            }
        }
        if ((samples_[s].needed & path_bit<Axes>) != 0)
            add_row(first + 2 * Axes, Row::tangential_acceleration, i,
                    sum(0.5 * sample.pace.value, w.slope, sample.pace.slope, w.b),
                    path_acceleration_share * limits_.path_acceleration);
        if ((samples_[s].needed & path_jerk_bit<Axes>) != 0)
            add_jerk(
                first + 2 * Axes + 1, Row::tangential_jerk, i,
                sum(0.5 * sample.pace.value, w.curve, 1, sum(1.5 * sample.pace.slope, w.slope, sample.pace.curve, w.b)),
                w.b, jerk_share * limits_.path_jerk);
        if ((samples_[s].needed & speed_bit<Axes>) != 0)
            add_row(first + 2 * Axes + 2, Row::bend, i, w.b, acceleration_share * sample.cap * sample.cap);
    }
}

// Functions that speed_problem.cpp and five_axis_speeds.cpp call, and that call each other.
template bool AxisSpeedProblem<3>::may_break(const Cell& cell, double part, double acceleration, double square,
                                             double jerk, double path_jerk) const;
template bool AxisSpeedProblem<5>::may_break(const Cell& cell, double part, double acceleration, double square,
                                             double jerk, double path_jerk) const;
template double AxisSpeedProblem<3>::acceleration_at_end(std::size_t cell) const;
template double AxisSpeedProblem<5>::greatest_share(std::size_t cell, const Sample& sample) const;
template double AxisSpeedProblem<5>::acceleration_at_end(std::size_t cell) const;
template AxisSpeedProblem<3>::AtBegin AxisSpeedProblem<3>::at_begin(std::size_t cell) const;
template std::uint16_t AxisSpeedProblem<3>::broken_at(const Sample& sample, const AtBegin& at, double part) const;
template AxisSpeedProblem<5>::AtBegin AxisSpeedProblem<5>::at_begin(std::size_t cell) const;
template std::uint16_t AxisSpeedProblem<5>::broken_at(const Sample& sample, const AtBegin& at, double part) const;
template double AxisSpeedProblem<5>::holding_share(const KnotState& start, const KnotState& end);
template void AxisSpeedProblem<5>::scale(double factor);
template void AxisSpeedProblem<3>::add_likely_rows();
template void AxisSpeedProblem<5>::add_likely_rows();
template bool AxisSpeedProblem<3>::add_violated_rows(double part);
template bool AxisSpeedProblem<5>::add_violated_rows(double part);
template void AxisSpeedProblem<3>::add_cap(std::uint32_t number, std::size_t cell, const Three& weights, double cap);
template void AxisSpeedProblem<5>::add_cap(std::uint32_t number, std::size_t cell, const Three& weights, double cap);
template void AxisSpeedProblem<3>::add_row(std::uint32_t number, Row kind, std::size_t cell, const Three& w,
                                           double limit);
template void AxisSpeedProblem<5>::add_row(std::uint32_t number, Row kind, std::size_t cell, const Three& w,
                                           double limit);
template void AxisSpeedProblem<3>::add_jerk(std::uint32_t number, Row kind, std::size_t cell, const Three& w,
                                            const Three& b, double limit);
template void AxisSpeedProblem<5>::add_jerk(std::uint32_t number, Row kind, std::size_t cell, const Three& w,
                                            const Three& b, double limit);
template void AxisSpeedProblem<3>::make_rows(const LimitRows* before);
template void AxisSpeedProblem<5>::make_rows(const LimitRows* before);
template void AxisSpeedProblem<3>::make_rows_of(std::size_t i);
template void AxisSpeedProblem<5>::make_rows_of(std::size_t i);

}  // namespace clsurf

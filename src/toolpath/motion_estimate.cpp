#include "toolpath/motion_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "core/error.h"
#include "core/statistics.h"
#include "core/units.h"
#include "log/quantum.h"
#include "toolpath/jumps_at_beginning.h"
#include "toolpath/smoother_fit.h"

namespace clsurf {
namespace {

constexpr double near_record = 0.05;  ///< leads this close to a whole number of records are rounded to it
/// A channel that differs from the speed by a larger share is not a measurement of it: a programmed feed, or a
/// filtered display.
constexpr double most_disagreement = 0.05;
/// Larger squared innovations are significant: 1 in 16,000 by chance (χ² with one degree of freedom).
constexpr double jump_gate = 16;
/// Records around a jump that it disturbs if positions have the same weight as the model; more if they have less.
constexpr double disturbed = 4, disturbed_by_width = 2;
/// This many standard deviations cover this share of the measured errors, as in a normal distribution.
constexpr double within_sigmas = 3, covered = 0.9973;
constexpr double most_nees = 2;

double norm(const SmoothedState& state, std::size_t d) { return std::sqrt(state[d].square().sum()); }

Measurements all_of(const MotionEstimate::Scratch& scratch) {
    const auto& [p, v, a] = scratch.measured;
    return {{p[0], p[1], p[2]}, {v[0], v[1], v[2]}, {a[0], a[1], a[2]}};
}

}  // namespace

MotionEstimate::MotionEstimate(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces)
    : log_(log), path_(path) {
    NoiseFitter fitter;
    if (FusedPositions::applies(log, path)) {
        fused_.emplace(log, path, pieces, fitter);
        path_ = fused_->path();
    }
    measure_positions(pieces, fitter);
    across_.emplace(model_);
    // With moving rotary axes, the axes' own speeds are not those of the tool.
    if (path.is_of_linear_axes()) measure_components(pieces);
    if (!model_.has_speed() && (path.role == Role::commanded || !log.has(Role::commanded))) measure_path_speed(pieces);
    calibrate(pieces);
    corners_.emplace(*across_, along_ ? &*along_ : nullptr);
}

void MotionEstimate::measure_positions(const std::vector<PointRange>& pieces, NoiseFitter& fitter) {
    double floor = finest_position;
    if (path_.is_of_linear_axes() && !fused_) {
        for (const ChannelView& view : path_.axes) floor = std::max(floor, quantum_of(view) / std::sqrt(12.0));
    }
    const double step = fused_ ? fused_->scale_floor() : floor;
    if (fused_) floor = fused_->floor();
    // An axis at rest has no information on the motion.
    std::vector<std::vector<double>> moving;
    for (const PointRange& sample : sample_sections(pieces)) {
        std::array<std::vector<double>, 3> p;
        for (std::vector<double>& axis : p) axis.resize(static_cast<std::size_t>(sample.size()));
        path_.read(sample.first, p[0], p[1], p[2]);
        for (std::vector<double>& axis : p) {
            if (!moves(axis, step)) continue;
            if (fused_)
                for (const PointRange& part : fused_->fused_ranges(sample))
                    moving.emplace_back(axis.begin() + (part.first - sample.first),
                                        axis.begin() + (part.last + 1 - sample.first));
            else
                moving.push_back(std::move(axis));
        }
    }
    const NoiseFit fit = fitter.fit(moving, floor);
    model_.period = path_.period;
    model_.position_sigma = fit.sigma;
    rounding_rules_ = fit.rounding_rules;
    if (fit.moved) model_.wandering = fit.wandering;
}

template <typename Visit>
void MotionEstimate::visit_samples(const std::vector<PointRange>& pieces, Visit&& visit) const {
    Scratch scratch;
    for (const PointRange& sample : sample_sections(pieces)) {
        read(sample.first, sample.last, scratch);
        const auto n = static_cast<std::size_t>(sample.size());
        scratch.states.resize(n);
        scratch.innovations.resize(n);
        across_->smooth(all_of(scratch), scratch.states, scratch.innovations);
        visit(scratch);
    }
}

/// Standard deviation of residual(scratch, i) over the sampled sections.
template <typename Residual>
double MotionEstimate::agreement(const std::vector<PointRange>& pieces, Residual&& residual) const {
    double squares = 0;
    double count = 0;
    visit_samples(pieces, [&](const Scratch& scratch) {
        for (std::size_t i = 0; i < scratch.states.size(); ++i) {
            const double off = residual(scratch, i);
            if (std::isnan(off)) continue;
            squares += off * off;
            ++count;
        }
    });
    return count > 0 ? std::sqrt(squares / count) : 0.0;
}

/// How many records measured(scratch, i) leads estimated(scratch, i), both Array3d: the minimum of their differences,
/// between records by a parabola through three sums of squares.
template <typename Measured, typename Estimated>
double MotionEstimate::lead_of(const std::vector<PointRange>& pieces, Measured&& measured,
                               Estimated&& estimated) const {
    std::array<double, 2 * most_lead + 1> squares{};
    visit_samples(pieces, [&](const Scratch& scratch) {
        const auto n = static_cast<PointIndex>(scratch.states.size());
        for (PointIndex i = most_lead; i < n - most_lead; ++i) {
            const Eigen::Array3d at = estimated(scratch, static_cast<std::size_t>(i));
            std::array<double, 2 * most_lead + 1> off{};
            for (PointIndex lead = -most_lead; lead <= most_lead; ++lead) {
                off[static_cast<std::size_t>(lead + most_lead)] =
                    (measured(scratch, static_cast<std::size_t>(i - lead)) - at).square().sum();
            }
            if (std::any_of(off.begin(), off.end(), [](double x) { return std::isnan(x); })) continue;
            for (std::size_t k = 0; k < off.size(); ++k) squares[k] += off[k];
        }
    });
    const auto least = static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
    const bool inside = least > 0 && least + 1 < squares.size();
    if (!inside || squares[least] > better_lead * squares[most_lead]) return 0;
    const double before = squares[least - 1], after = squares[least + 1];
    const double whole = static_cast<double>(least) - static_cast<double>(most_lead);
    const double part = 0.5 * (before - after) / (before - 2 * squares[least] + after);
    return std::abs(part) < near_record ? whole : whole + part;
}

void MotionEstimate::measure_components(const std::vector<PointRange>& pieces) {
    SmootherModel model = model_;
    for (std::size_t d = 0; d < 2; ++d) {
        std::array<const Channel*, 3> found{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            found[axis] = log_.find(fmt::format("{}.{}", d == 0 ? "speed" : "acceleration", "xyz"[axis]));
        if (std::count(found.begin(), found.end(), nullptr) > 0) continue;
        components_[d] = found;
        const auto measured = [d](const Scratch& s, std::size_t i) {
            return Eigen::Array3d(s.measured[d + 1][0][i], s.measured[d + 1][1][i], s.measured[d + 1][2][i]);
        };
        const auto estimated = [d](const Scratch& s, std::size_t i) -> Eigen::Array3d {
            return s.states[i][d + 1].head<3>();
        };
        component_lead_[d] = lead_of(pieces, measured, estimated);
        double quantum = 0;
        for (const Channel* channel : found) quantum = std::max(quantum, quantum_of(channel->values));
        quantum /= d == 0 ? seconds_per_minute : 1.0;
        double worst = 0;
        for (int axis = 0; axis < 3; ++axis) {
            worst = std::max(worst, agreement(pieces, [&](const Scratch& s, std::size_t i) {
                                 return measured(s, i)[axis] - estimated(s, i)[axis];
                             }));
        }
        // The residual also includes the uncertainty of the positions.
        const double known = across_->sigma(static_cast<int>(d) + 1);
        const double floor = std::max(quantum / std::sqrt(12.0), 1e-3 * known);
        const double sigma = std::sqrt(std::max(worst * worst - known * known, floor * floor));
        (d == 0 ? model.speed_sigma : model.acceleration_sigma) = sigma;
    }
    if (!model.has_speed() && !model.has_acceleration()) return;
    model_ = model;
    across_.emplace(model_);
}

void MotionEstimate::measure_path_speed(const std::vector<PointRange>& pieces) {
    path_speed_ = log_.find("speed");
    if (path_speed_ == nullptr) return;
    const auto measured = [](const Scratch& s, std::size_t i) { return Eigen::Array3d(s.path_speed[i], 0, 0); };
    const auto estimated = [](const Scratch& s, std::size_t i) { return Eigen::Array3d(norm(s.states[i], 1), 0, 0); };
    path_speed_lead_ = lead_of(pieces, measured, estimated);
    const double off =
        agreement(pieces, [](const Scratch& s, std::size_t i) { return s.path_speed[i] - norm(s.states[i], 1); });
    const double usual = agreement(pieces, [](const Scratch& s, std::size_t i) { return norm(s.states[i], 1); });
    if (off > most_disagreement * usual) {
        path_speed_ = nullptr;
        path_speed_lead_ = 0;
        return;
    }
    const double known = across_->sigma(1);
    const double floor = std::max(quantum_of(path_speed_->values) / seconds_per_minute / std::sqrt(12.0), 1e-3 * known);
    SmootherModel model = model_;
    model.speed_sigma = std::sqrt(std::max(off * off - known * known, floor * floor));
    along_.emplace(model);
}

/// The scale at which three standard deviations cover 99.73 % of the errors, from measurable errors: of estimates from
/// every second record against the differences of the records held out; of the estimates against the differences of
/// adjacent records, because between records a speed is not defined better; and against the channel.
void MotionEstimate::calibrate(const std::vector<PointRange>& pieces) {
    SmootherModel model;  // of every second record, positions alone
    model.period = 2 * model_.period;
    model.position_sigma = model_.position_sigma;
    model.wandering = two_periods_7 * model_.wandering;
    const KalmanSmoother half(model);
    const AccelerationCorners half_corners(half), corners(*across_);
    const double of_difference = std::pow(model_.position_sigma / model_.period, 2) / 2;
    const double known = std::pow(across_->sigma(1), 2);
    const double of_channel =
        path_speed_ == nullptr ? 0.0 : std::pow(quantum_of(path_speed_->values) / seconds_per_minute, 2) / 12;
    std::array<std::vector<double>, 3> ratios;  // squared errors of the speed, in units of their stated variance
    std::vector<double> of_difference_held_out;
    for (std::size_t k = 0; k < 3 && fused_; ++k) {
        const std::vector<double>& more = fused_->axes()[k].held_out;
        of_difference_held_out.insert(of_difference_held_out.end(), more.begin(), more.end());
    }
    const auto compare = [&ratios](std::size_t with, double off, double variance) {
        if (!std::isnan(off)) ratios[with].push_back(off * off / variance);
    };
    std::array<std::vector<double>, 3> even;
    Scratch halved;
    std::vector<double> sigmas;
    visit_samples(pieces, [&](Scratch& scratch) {
        const auto n = scratch.states.size();
        const std::size_t count = n / 2;
        const auto difference = [&](std::size_t i) {
            const auto& p = scratch.measured[0];
            return Vec3(p[0][i + 1] - p[0][i - 1], p[1][i + 1] - p[1][i - 1], p[2][i + 1] - p[2][i - 1]).norm() /
                   (2 * model_.period);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            even[axis].resize(count);
            for (std::size_t k = 0; k < count; ++k) even[axis][k] = scratch.measured[0][axis][2 * k];
        }
        halved.states.resize(count);
        halved.innovations.resize(count);
        sigmas.resize(count);
        half.smooth({{even[0], even[1], even[2]}, {}, {}}, halved.states, halved.innovations);
        half.sigmas(1, static_cast<PointIndex>(count), 0, sigmas);
        set_inflation(half_corners, 0, 0, static_cast<PointIndex>(count) - 1, halved);
        raise_at_beginning(half_corners, half, {{even[0], even[1], even[2]}, {}, {}}, 0, 0, halved.inflation);
        for (std::size_t k = 1; k + 1 < count; ++k) {
            compare(0, norm(halved.states[k], 1) - difference(2 * k),
                    sigmas[k] * sigmas[k] * halved.inflation[1][k] + of_difference);
        }
        set_inflation(corners, 0, 0, static_cast<PointIndex>(n) - 1, scratch);
        raise_at_beginning(corners, *across_, all_of(scratch), 0, 0, scratch.inflation);
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double speed = norm(scratch.states[i], 1);
            const double variance = known * scratch.inflation[1][i];
            compare(1, speed - difference(i), variance + of_difference);
            if (path_speed_ != nullptr) compare(2, speed - scratch.path_speed[i], variance + of_channel);
        }
    });
    set_scale(ratios, of_difference_held_out);
}

/// From squared errors in units of their stated variance, of each kind. Changes their order.
void MotionEstimate::set_scale(std::array<std::vector<double>, 3>& ratios, std::vector<double>& of_difference) {
    // While an axis moves by less than a step, its rounding error is constant: up to half a step, √3 of the standard
    // deviation of steps.
    double scale = rounding_rules_ ? 3 : 1;
    const auto raise = [](double& variance, std::vector<double>& of) {
        if (!of.empty()) variance = std::max(variance, nearest_quantile(of, covered) / (within_sigmas * within_sigmas));
    };
    for (std::vector<double>& of : ratios) raise(scale, of);
    double difference_scale = 1;
    raise(difference_scale, of_difference);
    scale_ = std::sqrt(scale);
    difference_scale_ = std::sqrt(difference_scale);
    nees_ = 0;
    const auto note = [this](const std::vector<double>& of, double variance) {
        const double sum = std::accumulate(of.begin(), of.end(), 0.0);
        if (!of.empty()) nees_ = std::max(nees_, sum / static_cast<double>(of.size()) / variance);
    };
    for (const std::vector<double>& of : ratios) note(of, scale);
    note(of_difference, difference_scale);
    if (nees_ > most_nees)
        throw InputError(
            Place::of_file(log_.name),
            fmt::format("the errors of a Kalman smoother are larger than what can be stated of them: their mean square "
                        "is {:.3g} times its expectation, where {} is the most",
                        nees_, most_nees),
            "use --derivative savgol");
}

PointIndex MotionEstimate::disturbed_points() const {
    return static_cast<PointIndex>(std::max(disturbed, disturbed_by_width * std::pow(model_.wandering, -1.0 / 8)));
}

/// For points [first, last], with innovations from `from` on: the greatest around a point, if they are significant. A jump
/// shows in one of them, or in the sum over as many as the estimate averages.
void MotionEstimate::set_inflation(const AccelerationCorners& corners, PointIndex from, PointIndex first,
                                   PointIndex last, Scratch& scratch) const {
    const PointIndex reach = disturbed_points();
    std::vector<double> of_jumps(static_cast<std::size_t>(last - first + 1), 1.0);
    const auto raise = [&](PointIndex around, PointIndex by, double squared) {
        if (!(squared > jump_gate)) return;
        for (PointIndex i = std::max(first, around - by); i <= std::min(last, around + by); ++i) {
            double& inflation = of_jumps[static_cast<std::size_t>(i - first)];
            inflation = std::max(inflation, squared);
        }
    };
    const std::vector<Eigen::Array4d>& innovations = scratch.innovations;
    const auto count = static_cast<PointIndex>(innovations.size());
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (PointIndex i = 0; i < count; ++i) {
        raise(from + i, reach, innovations[static_cast<std::size_t>(i)].square().maxCoeff());
        sum += innovations[static_cast<std::size_t>(i)];
        if (i >= reach) sum -= innovations[static_cast<std::size_t>(i - reach)];
        raise(from + i - reach / 2, reach, sum.square().maxCoeff() / static_cast<double>(reach));
    }
    scratch.inflation.fill(of_jumps);
    corners.raise(innovations, from, first, scratch.inflation);
}

void MotionEstimate::read(PointIndex first, PointIndex last, Scratch& scratch) const {
    const auto n = static_cast<std::size_t>(last - first + 1);
    for (auto& derivative : scratch.measured) {
        for (std::vector<double>& axis : derivative) axis.resize(n);
    }
    path_.read(first, scratch.measured[0][0], scratch.measured[0][1], scratch.measured[0][2]);
    for (std::size_t d = 0; d < 2; ++d) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (components_[d][axis] == nullptr) continue;
            std::vector<double>& values = scratch.measured[d + 1][axis];
            copy_ahead(components_[d][axis]->values, path_.count, first, component_lead_[d], values);
            if (d > 0) continue;
            for (double& value : values) value /= seconds_per_minute;
        }
    }
    if (path_speed_ == nullptr) return;
    scratch.path_speed.resize(n);
    copy_ahead(path_speed_->values, path_.count, first, path_speed_lead_, scratch.path_speed);
    for (double& value : scratch.path_speed) value /= seconds_per_minute;
}

void MotionEstimate::estimate(PointRange piece, PointIndex first, PointIndex last, Scratch& scratch,
                              std::array<std::array<std::vector<double>, 3>, 4>& out) const {
    // Jumps near the points disturb them, too, and their innovations need settled gains.
    const PointIndex reach = 3 * std::max(across_->reach(), along_ ? along_->reach() : 0) + 2 * disturbed_points();
    const PointIndex from = std::max(piece.first, first - reach);
    const PointIndex to = std::min(piece.last, last + reach);
    read(from, to, scratch);
    const auto n = static_cast<std::size_t>(to - from + 1);
    auto& [p, v, a] = scratch.measured;
    const Measurements measured = all_of(scratch);
    scratch.states.resize(n);
    scratch.innovations.resize(n);
    across_->smooth(measured, scratch.states, scratch.innovations);
    set_inflation(*corners_, from, first, last, scratch);
    if (from == piece.first) raise_at_beginning(*corners_, *across_, measured, from, first, scratch.inflation);
    if (along_) {
        // The channel measures the velocity component along the direction of the path, which follows from the
        // positions.
        for (std::size_t i = 0; i < n; ++i) {
            const double speed = norm(scratch.states[i], 1);
            const double factor = speed > 0 ? scratch.path_speed[i] / speed : 0.0;
            for (int axis = 0; axis < 3; ++axis)
                v[static_cast<std::size_t>(axis)][i] = factor * scratch.states[i][1][axis];
        }
        scratch.with_speed.resize(n);
        along_->smooth(measured, scratch.with_speed);
        const double slowest = 3 * across_->sigma(1);  // at a lower speed the path has no direction
        for (std::size_t i = 0; i < n; ++i) {
            SmoothedState& state = scratch.states[i];
            const double speed = norm(state, 1);
            if (!(speed > slowest)) continue;
            const Eigen::Array4d direction = state[1] / speed;
            for (std::size_t d = 0; d < 4; ++d)
                state[d] += ((scratch.with_speed[i][d] - state[d]) * direction).sum() * direction;
        }
    }
    const auto count = static_cast<std::size_t>(last - first + 1);
    const auto lead = static_cast<std::size_t>(first - from);
    for (std::size_t d = 0; d < 4; ++d) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double>& values = out[d][axis];
            values.resize(count);
            for (std::size_t i = 0; i < count; ++i) {
                const bool missing = std::isnan(p[axis][lead + i]);
                values[i] = missing ? std::numeric_limits<double>::quiet_NaN()
                                    : scratch.states[lead + i][d][static_cast<int>(axis)];
            }
        }
    }
}

void MotionEstimate::sigmas(int derivative, PointRange piece, PointIndex first, const Scratch& scratch,
                            std::span<double> out) const {
    best(derivative).sigmas(derivative, piece.size(), first - piece.first, out);
    const std::vector<double>& inflation = scratch.inflation[static_cast<std::size_t>(derivative)];
    for (std::size_t i = 0; i < out.size(); ++i) out[i] *= scale_ * std::sqrt(inflation[i]);
    if (!fused_) return;
    std::vector<double> worst(out.size(), 0.0), of_axis(out.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        difference_sigmas(axis, derivative, piece, first, of_axis);
        std::transform(worst.begin(), worst.end(), of_axis.begin(), worst.begin(),
                       [](double a, double b) { return std::max(a, b); });
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(out[i], difference_scale_ * worst[i]);
}

void MotionEstimate::position_sigmas(PointRange piece, PointIndex first, const Scratch& scratch,
                                     std::array<std::vector<double>, 3>& out) const {
    const std::size_t n = out[0].size();
    std::vector<double> common(n), of_axis(n, 0.0);
    best(0).sigmas(0, piece.size(), first - piece.first, common);
    for (std::size_t i = 0; i < n; ++i) common[i] *= scale_ * std::sqrt(scratch.inflation[0][i]);
    for (std::vector<double>& variances : out) variances.assign(n, 0.0);
    for (std::size_t axis = 0; axis < 3 && fused_; ++axis) {
        difference_sigmas(axis, 0, piece, first, of_axis);
        for (std::size_t along = 0; along < 3; ++along) {
            const double share = path_.turn(static_cast<int>(along), static_cast<int>(axis));
            for (std::size_t i = 0; i < n; ++i) out[along][i] += std::pow(share * difference_scale_ * of_axis[i], 2);
        }
    }
    for (std::vector<double>& values : out) {
        for (std::size_t i = 0; i < n; ++i) values[i] = std::sqrt(values[i] + common[i] * common[i]);
    }
}

/// The contribution of the encoder's difference. Where the scale is used alone, and up to the reach of its noise
/// around, the uncertainty is that of the scale.
void MotionEstimate::difference_sigmas(std::size_t axis, int derivative, PointRange piece, PointIndex first,
                                       std::span<double> out) const {
    const PointIndex reach = disturbed_points();
    const PointIndex from = std::max(piece.first, first - reach);
    const PointIndex to = std::min(piece.last, first + static_cast<PointIndex>(out.size()) - 1 + reach);
    std::vector<double> around(static_cast<std::size_t>(to - from + 1));
    fused_->sigmas(axis, derivative, from, around);
    const double most = scale_ / difference_scale_ * best(derivative).sigma(derivative) * fused_->alone();
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = std::min(most, around[static_cast<std::size_t>(first - from) + i]);
    for (PointIndex at = from; at <= to; ++at) {
        if (!std::isinf(around[static_cast<std::size_t>(at - from)])) continue;
        const PointIndex begin = std::max(first, at - reach);
        const PointIndex end = std::min(first + static_cast<PointIndex>(out.size()), at + reach + 1);
        for (PointIndex i = begin; i < end; ++i) out[static_cast<std::size_t>(i - first)] = most;
    }
}

double MotionEstimate::sigma(int derivative) const {
    const double of_difference = fused_ ? difference_scale_ * fused_->remaining(derivative) : 0.0;
    return std::hypot(scale_ * best(derivative).sigma(derivative), of_difference);
}

std::string MotionEstimate::note(int derivative) const {
    std::string text =
        fmt::format("Kalman smoother: positions \u00b1{:.2g} \u00b5m", model_.position_sigma * um_per_mm);
    if (fused_) text += fmt::format(" ({})", fused_->note());
    const double speed = along_ ? along_->model().speed_sigma : model_.speed_sigma;
    if (std::isfinite(speed)) text += fmt::format(", speeds \u00b1{:.2g} mm/min", speed * seconds_per_minute);
    const double lead = along_ ? path_speed_lead_ : component_lead_[0];
    if (lead != 0)
        text += fmt::format(", {:.3g} records {} the positions", std::abs(lead), lead > 0 ? "ahead of" : "behind");
    if (model_.has_acceleration())
        text += fmt::format(", accelerations \u00b1{:.2g} mm/s\u00b2", model_.acceleration_sigma);
    const double left = sigma(derivative);
    switch (derivative) {
        case 1: return text + fmt::format("; speed known to \u00b1{:.2g} mm/min", left * seconds_per_minute);
        case 2: return text + fmt::format("; acceleration known to \u00b1{:.2g} mm/s\u00b2", left);
        case 3: return text + fmt::format("; jerk known to \u00b1{:.2g} mm/s\u00b3", left);
        default: return text + fmt::format("; position known to \u00b1{:.2g} \u00b5m", left * um_per_mm);
    }
}

}  // namespace clsurf

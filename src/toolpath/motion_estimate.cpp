#include "toolpath/motion_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/statistics.h"
#include "core/units.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

constexpr PointIndex looked_at = 2000;   ///< points of a section that the model is measured on
constexpr PointIndex sections = 48;      ///< evenly spaced over the pieces
constexpr PointIndex least_piece = 100;  ///< points
constexpr double finest = 1e-8;          ///< [mm] no position is more exact
constexpr double most_wandering = 1e2, least_wandering = 1e-17;
constexpr double per_sigma = 1.4826;  ///< standard deviation over median of absolute deviations
/// A model is sure of itself only so far: the wandering is found to a factor of √10.
constexpr double wandering_step = 3.1622776601683795;

/// Sections spread over the pieces that are long enough to tell anything.
std::vector<PointRange> samples_of(const std::vector<PointRange>& pieces) {
    PointIndex all = 0;
    for (const PointRange& piece : pieces) all += piece.size() >= least_piece ? piece.size() : 0;
    const PointIndex every = std::max(looked_at, all / sections);
    std::vector<PointRange> samples;
    PointIndex next = 0;  // where the next section begins, counted from the piece's first point
    for (const PointRange& piece : pieces) {
        if (piece.size() < least_piece) continue;
        for (; next < piece.size(); next += every) {
            const PointIndex first = piece.first + std::min(next, piece.size() - least_piece);
            samples.push_back({first, std::min(piece.last, first + looked_at - 1)});
        }
        next -= piece.size();
    }
    if (samples.empty() && !pieces.empty())
        samples.push_back(*std::max_element(pieces.begin(), pieces.end(), [](const PointRange& a, const PointRange& b) {
            return a.size() < b.size();
        }));
    return samples;
}

double norm(const SmoothedState& state, std::size_t d) { return std::sqrt(state[d].square().sum()); }

}  // namespace

MotionEstimate::MotionEstimate(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces)
    : log_(log), path_(path) {
    measure_positions(pieces);
    across_.emplace(model_);
    // The axes' own speeds are not those of a tool that also turns.
    if (path.kinematics == nullptr) measure_components(pieces);
    if (!model_.has_speed() && (path.role == Role::commanded || !log.has(Role::commanded))) measure_path_speed(pieces);
}

void MotionEstimate::measure_positions(const std::vector<PointRange>& pieces) {
    double floor = finest;
    if (path_.kinematics == nullptr) {
        for (const ChannelView& view : path_.axes) floor = std::max(floor, quantum_of(view) / std::sqrt(12.0));
    }
    model_.period = path_.period;
    // An axis that stands still teaches nothing of the motion.
    std::vector<std::vector<double>> moving;
    for (const PointRange& sample : samples_of(pieces)) {
        std::array<std::vector<double>, 3> p;
        for (std::vector<double>& axis : p) axis.resize(static_cast<std::size_t>(sample.size()));
        path_.read(sample.first, p[0], p[1], p[2]);
        for (std::vector<double>& axis : p) {
            const auto [low, high] = std::minmax_element(axis.begin(), axis.end());
            constexpr double steps = 10;
            if (*high - *low > steps * floor) moving.push_back(std::move(axis));
        }
    }
    double least = std::numeric_limits<double>::infinity();
    model_.position_sigma = floor;
    for (double wandering = most_wandering; wandering > least_wandering; wandering /= wandering_step) {
        SmootherModel tried;
        tried.period = 1;
        tried.position_sigma = 1;
        tried.wandering = wandering;
        const KalmanSmoother filter(tried);
        double squares = 0;
        double count = 0;
        double log_variance = 0;
        for (const std::vector<double>& axis : moving) {
            const KalmanSmoother::Innovations sums = filter.innovations(axis);
            squares += sums.squares;
            count += static_cast<double>(sums.count);
            log_variance = sums.log_variance;
        }
        if (!(count > 0)) break;
        // The likelihood at its greatest over the uncertainty of a position, which the quantum bounds from below.
        const double variance = std::max(squares / count, floor * floor);
        const double cost = std::log(variance) + squares / count / variance + log_variance;
        if (!(cost < least)) continue;
        least = cost;
        model_.position_sigma = std::sqrt(variance);
        model_.wandering = wandering;
    }
}

/// Standard deviation of residual(states, sample, i) over the sampled sections, robust.
template <typename Residual>
double MotionEstimate::agreement(const std::vector<PointRange>& pieces, Residual&& residual) const {
    std::vector<double> all;
    Scratch scratch;
    for (const PointRange& sample : samples_of(pieces)) {
        read(sample.first, sample.last, scratch);
        scratch.states.resize(static_cast<std::size_t>(sample.size()));
        const auto& p = scratch.measured[0];
        across_->smooth({{p[0], p[1], p[2]}, {}, {}}, scratch.states);
        for (std::size_t i = 0; i < scratch.states.size(); ++i) {
            const double off = std::abs(residual(scratch, i));
            if (off == off) all.push_back(off);
        }
    }
    return all.empty() ? 0.0 : per_sigma * median(all);
}

void MotionEstimate::measure_components(const std::vector<PointRange>& pieces) {
    SmootherModel model = model_;
    for (std::size_t d = 0; d < 2; ++d) {
        std::array<const Channel*, 3> found{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            found[axis] = log_.find(fmt::format("{}.{}", d == 0 ? "speed" : "acceleration", "xyz"[axis]));
        if (std::count(found.begin(), found.end(), nullptr) > 0) continue;
        components_[d] = found;
        double quantum = 0;
        for (const Channel* channel : found) quantum = std::max(quantum, quantum_of(channel->values));
        quantum /= d == 0 ? seconds_per_minute : 1.0;
        double worst = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            worst = std::max(worst, agreement(pieces, [&](const Scratch& s, std::size_t i) {
                                 return s.measured[d + 1][axis][i] - s.states[i][d + 1][static_cast<int>(axis)];
                             }));
        }
        // The residual holds what the positions do not know, too.
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
    const double off =
        agreement(pieces, [](const Scratch& s, std::size_t i) { return s.path_speed[i] - norm(s.states[i], 1); });
    const double known = across_->sigma(1);
    const double floor = std::max(quantum_of(path_speed_->values) / seconds_per_minute / std::sqrt(12.0), 1e-3 * known);
    SmootherModel model = model_;
    model.speed_sigma = std::sqrt(std::max(off * off - known * known, floor * floor));
    along_.emplace(model);
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
            copy_block(components_[d][axis]->values, first, values);
            if (d > 0) continue;
            for (double& value : values) value /= seconds_per_minute;
        }
    }
    if (path_speed_ == nullptr) return;
    scratch.path_speed.resize(n);
    copy_block(path_speed_->values, first, scratch.path_speed);
    for (double& value : scratch.path_speed) value /= seconds_per_minute;
}

void MotionEstimate::estimate(PointRange piece, PointIndex first, PointIndex last, Scratch& scratch,
                              std::array<std::array<std::vector<double>, 3>, 4>& out) const {
    const PointIndex reach = std::max(across_->reach(), along_ ? along_->reach() : 0);
    const PointIndex from = std::max(piece.first, first - reach);
    const PointIndex to = std::min(piece.last, last + reach);
    read(from, to, scratch);
    const auto n = static_cast<std::size_t>(to - from + 1);
    auto& [p, v, a] = scratch.measured;
    Measurements measured{{p[0], p[1], p[2]}, {v[0], v[1], v[2]}, {a[0], a[1], a[2]}};
    scratch.states.resize(n);
    across_->smooth(measured, scratch.states);
    if (along_) {
        // What the speed measures is the velocity along the way that the positions tell.
        for (std::size_t i = 0; i < n; ++i) {
            const double speed = norm(scratch.states[i], 1);
            const double factor = speed > 0 ? scratch.path_speed[i] / speed : 0.0;
            for (int axis = 0; axis < 3; ++axis)
                v[static_cast<std::size_t>(axis)][i] = factor * scratch.states[i][1][axis];
        }
        scratch.with_speed.resize(n);
        along_->smooth(measured, scratch.with_speed);
        const double slowest = 3 * across_->sigma(1);  // slower, the way has no direction
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

void MotionEstimate::sigmas(int derivative, PointRange piece, PointIndex first, std::span<double> out) const {
    best(derivative).sigmas(derivative, piece.size(), first - piece.first, out);
}

std::string MotionEstimate::note(int derivative) const {
    std::string text =
        fmt::format("Kalman smoother: positions \u00b1{:.2g} \u00b5m", model_.position_sigma * um_per_mm);
    const double speed = along_ ? along_->model().speed_sigma : model_.speed_sigma;
    if (std::isfinite(speed)) text += fmt::format(", speeds \u00b1{:.2g} mm/min", speed * seconds_per_minute);
    if (model_.has_acceleration())
        text += fmt::format(", accelerations \u00b1{:.2g} mm/s\u00b2", model_.acceleration_sigma);
    const double left = sigma(derivative);
    switch (derivative) {
        case 1: return text + fmt::format("; speed known to \u00b1{:.2g} mm/min", left * seconds_per_minute);
        case 2: return text + fmt::format("; acceleration known to \u00b1{:.2g} mm/s\u00b2", left);
        case 3: return text + fmt::format("; jerk known to \u00b1{:.2g} mm/s\u00b3", left);
        default: return text;
    }
}

}  // namespace clsurf

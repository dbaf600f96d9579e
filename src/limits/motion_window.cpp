#include "limits/motion_window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/not_finite.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

// Differences over 2 to 16 periods, if rounding is more than 1 % of a limit: docs/limits.md#how-certain.
constexpr std::array<std::size_t, 8> stride_steps{1, 2, 3, 4, 6, 8, 12, 16};
constexpr double small_share = 0.01;  ///< of a limit
/// Greatest error of a difference of each order, in multiples of the resolution. Positions are off by half a step, and the
/// weights of differences add up to 2, 4 and 8.
constexpr std::array<double, 4> roundings{1, 1, 2, 4};
/// Rounding error of double arithmetic, relative to the greatest coordinate.
constexpr double last_places = 4 * std::numeric_limits<double>::epsilon();

/// Positions, or vectors of them, at up to four instants [s].
template <typename T>
struct Samples {
    std::array<T, 4> at;
    std::array<double, 4> times{};
};

/// The divided difference of the first order + 1 samples times the factorial of the order, which is the mean of the
/// derivative.
template <typename T>
T derivative_of(Samples<T> samples, std::size_t order) {
    for (std::size_t level = 1; level <= order; ++level) {
        for (std::size_t i = 0; i + level <= order; ++i) {
            const double rate = static_cast<double>(level) / (samples.times[i + level] - samples.times[i]);
            samples.at[i] = (samples.at[i + 1] - samples.at[i]) * rate;
        }
    }
    return samples.at[0];
}

/// `even`: a value for records one period apart, `timed`: the same by their times. It is not known which of them is right,
/// or in which proportion: the least value between them is certain.
double least_between(double even, double timed) {
    return even * timed <= 0 ? 0 : std::copysign(std::min(std::abs(even), std::abs(timed)), even);
}

/// The same for the length of a vector.
double least_norm_between(const Vec3& even, const Vec3& timed) {
    const Vec3 change = timed - even;
    const double squared = change.squaredNorm();
    const double share = squared > 0 ? std::clamp(-even.dot(change) / squared, 0.0, 1.0) : 0;
    return (even + share * change).norm();
}

/// 1 − cos of the angle between two steps; 1 if one of them has no direction.
double one_minus_cosine(const Vec3& a, const Vec3& b) {
    const double lengths = a.norm() * b.norm();
    return lengths > 0 ? std::max(0.0, 1 - a.dot(b) / lengths) : 1;
}

}  // namespace

CommandedMotion::CommandedMotion(const Log& log, const Trajectory& path, std::span<const StatedLimit> limits)
    : log_(&log), path_(&path) {
    for (const char letter : {'x', 'y', 'z', 'a', 'b', 'c'}) {
        const Channel* channel = log.find(std::string("cmd.") + letter);
        if (channel == nullptr) continue;
        CommandedAxis axis{letter, channel->values, letter < 'x' ? rad_per_deg : 1.0, 0};
        axis.resolution = resolution_of(channel->values) * axis.to_inside;
        if (letter >= 'x') rules_.resolution = std::max(rules_.resolution, axis.resolution);
        axes_.push_back(axis);
    }
    std::size_t with_jerk = 0, linear = 0;
    for (const CommandedAxis& axis : axes_) linear += axis.letter >= 'x' ? 1 : 0;
    for (const StatedLimit& limit : limits) {
        if (limit.quantity == LimitedQuantity::jerk && limit.axis >= 'x' && find(limit.axis) != nullptr) {
            ++with_jerk;
            rules_.jerk = std::max(rules_.jerk, limit.value);
        }
        limits_path_ = limits_path_ || limit.axis == 0;
        if (row_of(limit.quantity).order == 2 && (limit.axis == 0 || limit.axis >= 'x'))
            rules_.acceleration = std::max(rules_.acceleration, limit.value);
    }
    if (with_jerk < linear) rules_.jerk = 0;
    if (const Channel* time = log.find("time")) rules_.time_resolution = resolution_of(time->values);
}

const CommandedAxis* CommandedMotion::find(char letter) const {
    const auto found =
        std::find_if(axes_.begin(), axes_.end(), [&](const auto& axis) { return axis.letter == letter; });
    return found == axes_.end() ? nullptr : &*found;
}

double CommandedMotion::tip_resolution(const Vec3& linear, const Vec3& rotary) const {
    const Kinematics& kinematics = *path_->kinematics;
    const LeverArms arms = kinematics.lever_arms(linear, kinematics.angles_of(rotary));
    // Even if the axis of a ball end mill is vertical, its tip moves with the axis.
    return resolution() + find(kinematics.tilt.letter)->resolution * (arms.tilt + path_->ball) +
           find(kinematics.rotation.letter)->resolution * (arms.rotation + path_->ball);
}

double CommandedMotion::path_resolution() const {
    if (!has_tip()) return resolution();
    constexpr PointIndex samples = 64;
    double coarsest = 0;
    for (PointIndex s = 0; s < samples && log_->records > 0; ++s) {
        const PointIndex point = (log_->records - 1) * s / (samples - 1);
        Vec3 linear = Vec3::Zero(), rotary = Vec3::Zero();
        for (const CommandedAxis& axis : axes_) {
            const double position = axis.positions.at(point) * axis.to_inside;
            if (axis.letter >= 'x')
                linear[axis.letter - 'x'] = position;
            else
                rotary[axis.letter - 'a'] = position;
        }
        coarsest = std::max(coarsest, tip_resolution(linear, rotary));
    }
    return coarsest;
}

std::vector<Stride> strides_for(const StatedLimit& limit, const CommandedMotion& motion) {
    const int order = row_of(limit.quantity).order;
    const CommandedAxis* axis = motion.find(limit.axis);
    const double resolution = axis != nullptr ? axis->resolution : motion.path_resolution();
    std::vector<Stride> strides;
    for (const std::size_t records : stride_steps) {
        const double time = static_cast<double>(records) * motion.log().period;
        const double at_once = roundings[static_cast<std::size_t>(order)] / std::pow(time, order);
        strides.push_back({records, at_once});
        if (at_once * resolution < small_share * limit.value) break;
    }
    return strides;
}

MotionWindow::MotionWindow(const CommandedMotion& motion, PointRange records) : motion_(&motion), records_(records) {
    begin_ = std::max<PointIndex>(0, records.first - margin);
    const PointIndex end = std::min(motion.log().records, records.last + margin + 1);
    count_ = static_cast<std::size_t>(end - begin_);
    for (std::vector<double>& column : linear_) column.assign(count_, 0.0);
    for (const CommandedAxis& axis : motion.axes()) {
        std::vector<double>& column = axes_.emplace_back(count_);
        copy_block(axis.positions, begin_, column);
        if (axis.to_inside != 1)
            for (double& value : column) value *= axis.to_inside;
        if (axis.letter >= 'x') linear_[static_cast<std::size_t>(axis.letter - 'x')] = column;
    }
    if (motion.has_tip() && motion.limits_path()) read_tip();
    steps_ = judge_steps(motion.log(), motion.clock(), begin_, linear_[0], linear_[1], linear_[2]);
    breaks_.resize(count_);
    for (std::size_t i = 1; i < count_; ++i) breaks_[i] = breaks_[i - 1] + static_cast<std::uint32_t>(steps_.broken[i]);
}

void MotionWindow::read_tip() {
    for (std::vector<double>& column : tip_) column.resize(count_);
    motion_->path().read(begin_, tip_[0], tip_[1], tip_[2]);
    tip_resolutions_.resize(count_);
    const std::array rotary{column_of('a'), column_of('b'), column_of('c')};
    for (std::size_t i = 0; i < count_; ++i) {
        Vec3 angles = Vec3::Zero();
        for (std::size_t axis = 0; axis < rotary.size(); ++axis)
            if (rotary[axis] != nullptr) angles[static_cast<Eigen::Index>(axis)] = (*rotary[axis])[i];
        tip_resolutions_[i] = motion_->tip_resolution({linear_[0][i], linear_[1][i], linear_[2][i]}, angles);
    }
}

const std::vector<double>* MotionWindow::column_of(char letter) const {
    const CommandedAxis* axis = motion_->find(letter);
    return axis == nullptr ? nullptr : &axes_[static_cast<std::size_t>(axis - motion_->axes().data())];
}

double MotionWindow::path_resolution(std::size_t first, std::size_t i, std::size_t last) const {
    if (tip_resolutions_.empty()) return motion_->resolution();
    return std::max({tip_resolutions_[first], tip_resolutions_[i], tip_resolutions_[last]});
}

std::vector<PointIndex> MotionWindow::broken() const {
    std::vector<PointIndex> found;
    for (PointIndex point = records_.first; point <= records_.last; ++point) {
        if (steps_.broken[static_cast<std::size_t>(point - begin_)] != 0) found.push_back(point);
    }
    return found;
}

double MotionWindow::time_between(std::size_t first, std::size_t last) const {
    const double late = steps_.late.empty() ? 0 : steps_.late[last] - steps_.late[first];
    return static_cast<double>(last - first) * motion_->log().period + late;
}

/// The factor by which rounding grows if records are closer together than a period, for differences from `first` on.
double MotionWindow::crowding(std::size_t first, std::size_t stride, int order) const {
    if (!is_timed()) return 1;
    const double even = static_cast<double>(stride) * motion_->log().period;
    double closest = even;
    for (std::size_t step = 0; step < static_cast<std::size_t>(order); ++step)
        closest = std::min(closest, time_between(first + step * stride, first + (step + 1) * stride));
    return std::pow(even / closest, order);
}

/// Contribution of the clock's rounding to a derivative: each time has an error of half its resolution.
double MotionWindow::clock_noise(double speed, double rate, int order) const {
    if (!is_timed()) return 0;
    return roundings[static_cast<std::size_t>(order)] * speed * motion_->clock().time_resolution *
           std::pow(rate, order);
}

MotionWindow::Value MotionWindow::of_axis(std::span<const double> x, std::size_t i, std::size_t stride,
                                          int order) const {
    const double rate = 1 / (static_cast<double>(stride) * motion_->log().period);
    const double speed = std::abs(x[i] - x[i - stride]) * rate;
    const double places = last_places * std::abs(x[i]);
    double value = 0;
    if (order == 1) value = (x[i] - x[i - stride]) * rate;
    if (order == 2) value = (x[i + stride] - 2 * x[i] + x[i - stride]) * rate * rate;
    if (order == 3) value = (x[i + stride] - 3 * x[i] + 3 * x[i - stride] - x[i - 2 * stride]) * rate * rate * rate;
    const double arithmetic = roundings[static_cast<std::size_t>(order)] * places * std::pow(rate, order);
    if (!is_timed()) return {std::abs(value), arithmetic};
    Samples<double> samples;
    const std::size_t first = i - (order == 3 ? 2 : 1) * stride;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(order); ++k) {
        samples.at[k] = x[first + k * stride];
        samples.times[k] = time_between(first, first + k * stride);
    }
    const double fastest = order == 1 ? speed : std::max(speed, std::abs(x[i + stride] - x[i]) * rate);
    return {std::abs(least_between(value, derivative_of(samples, static_cast<std::size_t>(order)))),
            arithmetic + clock_noise(fastest, rate, order)};
}

MotionWindow::Value MotionWindow::of_path(std::size_t i, std::size_t stride, LimitedQuantity quantity,
                                          double rounding) const {
    const double rate = 1 / (static_cast<double>(stride) * motion_->log().period);
    const Vec3 here = place(i);
    const Vec3 in = here - place(i - stride);
    const double places = last_places * here.cwiseAbs().maxCoeff();
    const double speed = in.norm() * rate;
    if (quantity == LimitedQuantity::path_speed)
        return {std::min(speed, in.norm() / time_between(i - stride, i)), places * rate + clock_noise(speed, rate, 1)};
    const Vec3 out = place(i + stride) - here;
    const Vec3 chord = in + out;
    const double length = chord.norm();
    const double noise = 2 * places * rate * rate + clock_noise(std::max(speed, out.norm() * rate), rate, 2);
    const Vec3 acceleration = (out - in) * (rate * rate);
    if (!(length > 0)) return {0, 0, acceleration.norm()};  // a reversal has no direction
    double along = acceleration.dot(chord) / length;
    Vec3 beside = acceleration - along / length * chord;
    double across = beside.norm();
    if (is_timed()) {
        const Samples<Vec3> samples{{Vec3(-in), Vec3::Zero(), out, Vec3::Zero()},
                                    {0, time_between(i - stride, i), time_between(i - stride, i + stride), 0}};
        const Vec3 timed = derivative_of(samples, 2);
        const double timed_along = timed.dot(chord) / length;
        across = least_norm_between(beside, timed - timed_along / length * chord);
        along = least_between(along, timed_along);
    }
    // The direction turns within the difference, and rounding changes it: each component contains a share of the other.
    const double lengths = in.norm() * out.norm();
    const bool is_sharp = !(lengths > 0) || in.dot(out) < 0;  // beyond a right angle the sine decreases again
    const double turn = is_sharp ? 1 : std::min(1.0, in.cross(out).norm() / lengths);
    const double slack = 0.5 * turn + std::min(1.0, rounding / (rate * rate) / length);
    if (quantity == LimitedQuantity::tangential_acceleration) return {std::abs(along), noise, across * slack};
    if (is_sharp && may_stop(i, stride)) return {across, 0, across};
    return {across, noise, std::abs(along) * slack};
}

/// Whether the path may have stopped in a sharp corner between the records about i. It then brakes and leaves along
/// straight lines, and tangential acceleration looks like normal acceleration. At constant acceleration the step before is
/// at least 5/3 of the step that leads to the corner, or the step after it at least 5/3 of the step that leaves it.
bool MotionWindow::may_stop(std::size_t i, std::size_t stride) const {
    if (i < 2 * stride || i + 2 * stride >= count_) return true;
    constexpr double braking = 1.5;
    const auto step = [&](std::size_t from) { return (place(from + stride) - place(from)).norm(); };
    return step(i - 2 * stride) > braking * step(i - stride) || step(i + stride) > braking * step(i);
}

/// The second difference of chords. On a bend they are shorter than the path, although the speed does not change.
MotionWindow::Value MotionWindow::path_jerk(std::size_t i, std::size_t stride) const {
    if (i < 3 * stride || i + 2 * stride >= count_) return {missing<double>, 0};
    const double rate = 1 / (static_cast<double>(stride) * motion_->log().period);
    const double cubed_rate = rate * rate * rate;
    std::array<Vec3, 5> chords;
    for (std::size_t c = 0; c < chords.size(); ++c)
        chords[c] = place(i + c * stride - 2 * stride) - place(i + c * stride - 3 * stride);
    double shortening = 0, longest = 0;
    for (std::size_t c = 1; c < 4; ++c) {
        const double weight = c == 2 ? 2 : 1;
        const double turned =
            0.5 * (one_minus_cosine(chords[c - 1], chords[c]) + one_minus_cosine(chords[c], chords[c + 1]));
        shortening += weight * turned * chords[c].norm();
        longest = std::max(longest, chords[c].norm());
    }
    double value = (chords[3].norm() - 2 * chords[2].norm() + chords[1].norm()) * cubed_rate;
    if (is_timed()) {
        // Speeds at the middle of three steps.
        Samples<double> speeds;
        for (std::size_t step = 0; step < 3; ++step) {
            const std::size_t from = i + step * stride - 2 * stride;
            const double time = time_between(from, from + stride);
            speeds.at[step] = chords[step + 1].norm() / time;
            speeds.times[step] = time_between(i - 2 * stride, from) + 0.5 * time;
        }
        value = least_between(value, derivative_of(speeds, 2));
    }
    const double places = 4 * last_places * place(i).cwiseAbs().maxCoeff() * cubed_rate;
    return {std::abs(value), places + clock_noise(longest * rate, rate, 3), shortening * cubed_rate};
}

std::vector<MeasuredValue> MotionWindow::measure(const StatedLimit& limit, std::span<const Stride> strides) const {
    const auto n = static_cast<std::size_t>(records_.size());
    std::vector<MeasuredValue> measured(n, {missing<double>, missing<double>, 0});
    const int order = row_of(limit.quantity).order;
    const CommandedAxis* axis = motion_->find(limit.axis);
    const std::vector<double>* column = column_of(limit.axis);
    const auto offset = static_cast<std::size_t>(records_.first - begin_);
    for (const Stride& stride : strides) {
        const std::size_t s = stride.records;
        const std::size_t before = order == 3 ? 2 * s : s, after = order == 1 ? 0 : s;
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = offset + k;
            if (i < before || i + after >= count_ || !clean(i - before, i + after)) continue;
            const double rounding = stride.roundings * crowding(i - before, s, order) *
                                    (axis != nullptr ? axis->resolution : path_resolution(i - before, i, i + after));
            const Value value = column != nullptr ? of_axis(*column, i, s, order)
                                : limit.quantity == LimitedQuantity::path_jerk
                                    ? path_jerk(i, s)
                                    : of_path(i, s, limit.quantity, rounding);
            const double noise = value.noise + rounding, uncertainty = noise + value.bend;
            const double lower_bound = measured[k].value - measured[k].uncertainty;
            if (lower_bound >= value.value - uncertainty || !std::isfinite(value.value)) continue;
            measured[k] = {value.value, uncertainty, noise};
        }
    }
    return measured;
}

}  // namespace clsurf

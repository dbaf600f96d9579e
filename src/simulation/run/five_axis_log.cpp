#include "simulation/run/five_axis_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/block.h"

namespace clsurf {

void FiveAxisLog::add(FiveAxisPoint point, const LimitExcess& exceeds) {
    if (servos_.empty()) {
        last_.fill(point.commanded);
        last_tip_ = tip_of(point);
        for (std::size_t k = 0; k < 5; ++k) {
            const ServoModel& model = k < 3 ? machine_->axes[k].servo : machine_->rotary[k - 3].servo;
            servos_.emplace_back(model, period_, point.commanded[k], k + 1);
        }
    }
    for (std::size_t k = 0; k < 5; ++k) point.feedback[k] = servos_[k].follow(point.commanded[k]);
    ++summary_.run.limited_by[static_cast<std::size_t>(point.limit)];
    measure(point, exceeds);
    measure_path(point);
    ++points_;
    block_of_points_.push_back(point);
    if (static_cast<PointIndex>(block_of_points_.size()) == block_points) flush();
}

FiveAxisSummary FiveAxisLog::finish() {
    flush();
    summary_.run.points = points_;
    summary_.run.duration = static_cast<double>(std::max<PointIndex>(0, points_ - 1)) * period_;
    SimulationSummary& run = summary_.run;
    normal_.add(Vec3::Zero(), 0);
    run.max_normal_acceleration = normal_.greatest();
    const LimitExcessOfPath excess = excess_of_path(run, *machine_);
    summary_.axes_ok = held_;
    run.limits_ok = held_ && excess.what.empty();
    if (!excess.what.empty())
        run.diagnostics.add({Severity::warning, "motion.limits", Place::of_file(program_->main().name()),
                             fmt::format("the {} reaches {:.3g} times its limit", excess.what, excess.factor),
                             "`clsurf check PROGRAM LOG --machine FILE` names the line"});
    return std::move(summary_);
}

Vec3 FiveAxisLog::tip_of(const FiveAxisPoint& point) const {
    const std::array<double, 5>& p = point.commanded;
    return machine_->kinematics.to_workpiece({p[0], p[1], p[2]}, {p[3], p[4]}).tip;
}

void FiveAxisLog::measure_path(const FiveAxisPoint& point) {
    const Vec3 tip = tip_of(point);
    normal_.add(tip - last_tip_, point.speed);
    const double change = (point.speed - last_speed_) / period_;
    SimulationSummary& run = summary_.run;
    run.max_tangential_acceleration = std::max(run.max_tangential_acceleration, std::abs(change));
    run.max_tangential_jerk = std::max(run.max_tangential_jerk, std::abs(change - last_change_) / period_);
    last_tip_ = tip;
    last_speed_ = point.speed;
    last_change_ = change;
}

void FiveAxisLog::measure(const FiveAxisPoint& point, const LimitExcess& exceeds) {
    const std::array<AxisLimits, 5>& limits = *limits_;
    const auto hold = [&](std::size_t axis, double value, double limit, int order) {
        if (!(value > limit * limit_tolerance)) return;
        held_ = false;
        if (exceeds) exceeds(axis, value, limit, order);
    };
    for (std::size_t k = 0; k < 5; ++k) {
        const double p = point.commanded[k];
        const double speed = std::abs(p - last_[0][k]) / period_;
        const double acceleration = std::abs(p - 2 * last_[0][k] + last_[1][k]) / (period_ * period_);
        const double jerk =
            std::abs(p - 3 * last_[0][k] + 3 * last_[1][k] - last_[2][k]) / (period_ * period_ * period_);
        hold(k, speed, limits[k].speed, 1);
        hold(k, acceleration, limits[k].acceleration, 2);
        hold(k, jerk, limits[k].jerk, 3);
        if (k < 3) {
            const auto axis = static_cast<int>(k);
            SimulationSummary& run = summary_.run;
            run.max_axis_speed[axis] = std::max(run.max_axis_speed[axis], speed);
            run.max_acceleration[axis] = std::max(run.max_acceleration[axis], acceleration);
            run.max_jerk[axis] = std::max(run.max_jerk[axis], jerk);
        } else {
            summary_.max_speed[k - 3] = std::max(summary_.max_speed[k - 3], speed);
            summary_.max_acceleration[k - 3] = std::max(summary_.max_acceleration[k - 3], acceleration);
            summary_.max_jerk[k - 3] = std::max(summary_.max_jerk[k - 3], jerk);
        }
        note_travel(k, p, point.line);
    }
    summary_.run.max_speed = std::max(summary_.run.max_speed, point.speed);
    last_ = {point.commanded, last_[0], last_[1]};
}

void FiveAxisLog::note_travel(std::size_t axis, double position, LineNumber line) {
    const AxisLimits& limits = (*limits_)[axis];
    const bool outside = position < limits.low || position > limits.high;
    if (outside && !outside_[axis]) {
        const double shown = axis < 3 ? 1.0 : deg_per_rad;
        const char letter = axis < 3    ? "xyz"[axis]
                            : axis == 3 ? machine_->kinematics.tilt.letter
                                        : machine_->kinematics.rotation.letter;
        summary_.run.diagnostics.add({Severity::warning,
                                      "motion.travel",
                                      Place::of_line(program_->main().name(), line),
                                      fmt::format("{} leaves its travel of {:g} … {:g} {}", letter, limits.low * shown,
                                                  limits.high * shown, axis < 3 ? "mm" : "deg"),
                                      {}});
    }
    outside_[axis] = outside;
}

void FiveAxisLog::flush() {
    if (*sink_ && !block_of_points_.empty()) (*sink_)(block_of_points_);
    block_of_points_.clear();
}

}  // namespace clsurf

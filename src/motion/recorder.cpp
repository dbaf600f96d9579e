#include "motion/recorder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr double limit_play = 1.001;  ///< what counts as held, differentiated

}  // namespace

Recorder::Recorder(const Program& program, const Machine& machine, const Vec3& start, const PointSink& sink)
    : program_(&program), machine_(&machine), sink_(&sink), rate_(1 / machine.controller.period), last_(start) {
    for (std::size_t i = 0; i < 3; ++i) {
        servos_.emplace_back(machine.axes[i].servo, machine.controller.period, start[static_cast<int>(i)], i + 1);
    }
    block_.reserve(static_cast<std::size_t>(block_points));
}

void Recorder::add(const Vec3& position, double speed, LineNumber line, Ruling ruling, double deviation) {
    SimulatedPoint& point = block_.emplace_back();
    point.commanded = position;
    point.speed = speed;
    point.line = line;
    point.limit = ruling;
    for (int i = 0; i < 3; ++i) point.feedback[i] = servos_[static_cast<std::size_t>(i)].follow(position[i]);
    measure(position, line);
    summary_.path_deviation = std::max(summary_.path_deviation, deviation);
    ++summary_.ruled[static_cast<std::size_t>(ruling)];
    ++summary_.points;
    if (static_cast<PointIndex>(block_.size()) == block_points) flush();
}

void Recorder::flush() {
    (*sink_)(block_);
    block_.clear();
}

void Recorder::measure(const Vec3& position, LineNumber line) {
    // Before the first point the axes stand at the start.
    const Vec3 step = position - last_;
    const Vec3 bend = step - last_step_;
    const Vec3 twist = bend - last_bend_;
    greatest_step_ = std::max(greatest_step_, step.squaredNorm());
    step_ = step_.cwiseMax(step.cwiseAbs());
    bend_ = bend_.cwiseMax(bend.cwiseAbs());
    twist_ = twist_.cwiseMax(twist.cwiseAbs());
    last_ = position;
    last_step_ = step;
    last_bend_ = bend;
    watch_travel(position, line);
}

void Recorder::watch_travel(const Vec3& position, LineNumber line) {
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const MachineAxis& axis = machine_->axes[k];
        const bool outside = position[i] < axis.travel_low || position[i] > axis.travel_high;
        if (outside && !outside_[k]) {
            summary_.diagnostics.add({Severity::warning, "motion.travel", Place::of_line(program_->main().name(), line),
                                      fmt::format("{} leaves its travel of {} … {} mm", axis_names[k], axis.travel_low, axis.travel_high),
                                      "positions are those of the program: is the work offset not zero?"});
        }
        outside_[k] = outside;
    }
}

SimulationSummary Recorder::finish() {
    flush();
    SimulationSummary& s = summary_;
    s.duration = static_cast<double>(std::max<PointIndex>(0, s.points - 1)) * machine_->controller.period;
    s.max_speed = std::sqrt(greatest_step_) * rate_;
    s.max_axis_speed = step_ * rate_;
    s.max_acceleration = bend_ * (rate_ * rate_);
    s.max_jerk = twist_ * (rate_ * rate_ * rate_);
    s.limits_ok = s.max_speed <= machine_->path.max_speed * limit_play;
    for (int i = 0; i < 3; ++i) {
        const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
        s.limits_ok = s.limits_ok && s.max_axis_speed[i] <= axis.max_speed * limit_play;
        s.limits_ok = s.limits_ok && s.max_acceleration[i] <= axis.max_acceleration * limit_play;
        s.limits_ok = s.limits_ok && (axis.max_jerk <= 0 || s.max_jerk[i] <= axis.max_jerk * limit_play);
    }
    return std::move(s);
}

}  // namespace clsurf

#include "simulation/run/recorder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "machine/limit_table.h"

namespace clsurf {

Recorder::Recorder(const Program& program, const Machine& machine, const Vec3& start, const PointSink& sink)
    : program_(&program),
      machine_(&machine),
      sink_(&sink),
      rate_(1 / machine.controller.period),
      servos_{ServoLoop(machine.axes[0].servo, machine.controller.period, start.x(), 1),
              ServoLoop(machine.axes[1].servo, machine.controller.period, start.y(), 2),
              ServoLoop(machine.axes[2].servo, machine.controller.period, start.z(), 3)},
      last_(start),
      normal_(machine.controller.period) {
    block_.reserve(points_at_once);
}

void Recorder::flush() {
    follow();
    measure();
    (*sink_)(block_);
    block_.clear();
}

/// Runs the servo loops for the points.
void Recorder::follow() {
    std::array<ServoLoop, 3> servos = servos_;  // local copy, kept in registers
    for (SimulatedPoint& point : block_) {
        for (int i = 0; i < 3; ++i) point.feedback[i] = servos[static_cast<std::size_t>(i)].follow(point.commanded[i]);
        ++summary_.limited_by[static_cast<std::size_t>(point.limit)];
    }
    servos_ = servos;
}

/// Before the first point the axes are at the start.
void Recorder::measure() {
    Vec3 last = last_, last_step = last_step_, last_bend = last_bend_;
    double last_speed = last_speed_, last_change = last_change_;
    double greatest_change = speed_change_, greatest_second = second_change_;
    Vec3 greatest = step_, greatest_bend = bend_, greatest_twist = twist_, low = last_, high = last_;
    for (const SimulatedPoint& point : block_) {
        const Vec3 step = point.commanded - last;
        const Vec3 bend = step - last_step;
        const Vec3 twist = bend - last_bend;
        greatest_step_ = std::max(greatest_step_, step.squaredNorm());
        greatest = greatest.cwiseMax(step.cwiseAbs());
        greatest_bend = greatest_bend.cwiseMax(bend.cwiseAbs());
        greatest_twist = greatest_twist.cwiseMax(twist.cwiseAbs());
        low = low.cwiseMin(point.commanded);
        high = high.cwiseMax(point.commanded);
        const double change = point.speed - last_speed;
        normal_.add(step, point.speed);
        greatest_change = std::max(greatest_change, std::abs(change));
        greatest_second = std::max(greatest_second, std::abs(change - last_change));
        last_speed = point.speed;
        last_change = change;
        last = point.commanded;
        last_step = step;
        last_bend = bend;
    }
    last_ = last;
    last_step_ = last_step;
    last_bend_ = last_bend;
    last_speed_ = last_speed;
    last_change_ = last_change;
    speed_change_ = greatest_change;
    second_change_ = greatest_second;
    step_ = greatest;
    bend_ = greatest_bend;
    twist_ = greatest_twist;
    const auto inside = [&](std::size_t k) {
        const MachineAxis& axis = machine_->axes[k];
        const auto i = static_cast<int>(k);
        return !outside_[k] && low[i] >= axis.travel_low && high[i] <= axis.travel_high;
    };
    if (inside(0) && inside(1) && inside(2)) return;
    for (const SimulatedPoint& point : block_) watch_travel(point.commanded, point.line);
}

void Recorder::watch_travel(const Vec3& position, LineNumber line) {
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const MachineAxis& axis = machine_->axes[k];
        const bool outside = position[i] < axis.travel_low || position[i] > axis.travel_high;
        if (outside && !outside_[k]) {
            summary_.diagnostics.add(
                {Severity::warning, "motion.travel", Place::of_line(program_->main().name(), line),
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
    s.max_tangential_acceleration = speed_change_ * rate_;
    s.max_tangential_jerk = second_change_ * (rate_ * rate_);
    normal_.add(Vec3::Zero(), 0);
    s.max_normal_acceleration = normal_.greatest();
    judge_limits();
    return std::move(s);
}

/// Checks whether all limits were kept, and reports those that were not.
void Recorder::judge_limits() {
    SimulationSummary& s = summary_;
    LimitExcessOfPath worst = excess_of_path(s, *machine_);
    const auto judge = [&](double value, double limit, const std::string& what) {
        if (limit <= 0 || value <= worst.factor * limit) return;
        worst = {value / limit, what};
    };
    const std::array<const Vec3*, 4> greatest{nullptr, &s.max_axis_speed, &s.max_acceleration, &s.max_jerk};
    // At corners that are not rounded the axis speeds step, which does not count as an excess.
    const int highest_order = machine_->controller.corner == CornerMode::junction ? 1 : 3;
    for (const LimitTableRow& row : limit_table) {
        if (row.of_axis == nullptr || row.order > highest_order) continue;
        for (std::size_t i = 0; i < machine_->axes.size(); ++i) {
            judge((*greatest[static_cast<std::size_t>(row.order)])[static_cast<Eigen::Index>(i)],
                  machine_->axes[i].*row.of_axis, fmt::format("{} of {}", row.name, axis_names[i]));
        }
    }
    s.limits_ok = worst.what.empty();
    if (s.limits_ok) return;
    s.diagnostics.add({Severity::warning, "motion.limits", Place::of_file(program_->main().name()),
                       fmt::format("the {} reaches {:.3g} times its limit", worst.what, worst.factor),
                       "`clsurf check PROGRAM LOG --machine FILE` names the line"});
}

}  // namespace clsurf

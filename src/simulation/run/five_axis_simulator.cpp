#include "simulation/run/five_axis_simulator.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/not_finite.h"
#include "simulation/path/five_axis_blocks.h"
#include "simulation/run/five_axis_log.h"
#include "simulation/run/five_axis_run.h"
#include "simulation/run/simulator.h"

namespace clsurf {
namespace {

// most_slower_rounds, half_width, shortest_resolved_ramp: docs/simulate.md#five-axes.
constexpr int most_slower_rounds = 32;
constexpr int half_width = 8;             ///< of the smoothing of angles [periods]
constexpr int carry_periods = 16;         ///< periods over which angles catch up after a rounded corner skipped some
constexpr int patient_rounds = 8;         ///< number of rounds before the jerk limit of the tip is lowered
constexpr double most_lowering = 0.97;    ///< least factor of that limit in a round
constexpr double nearly_greatest = 0.95;  ///< a rate that counts as the greatest
/// Makes the samples of the axes from the samples of the tip.
class FiveAxisRecorder {
public:
    FiveAxisRecorder(const FiveAxisBlocks& blocks, const Program& program, const Machine& machine,
                     const FiveAxisSink& sink)
        : blocks_(&blocks),
          machine_(&machine),
          period_(machine.controller.period),
          excesses_(blocks.count()),
          log_(program, machine, blocks.limits(), sink) {}

    void add(std::span<const SimulatedPoint> points) {
        for (const SimulatedPoint& point : points) add(point);
    }

    FiveAxisSummary finish() {
        // The angles come to rest after the tip.
        if (!waiting_.empty()) {
            Sample last = waiting_.back();
            last.point.speed = 0;
            last.point.limit = LimitingFactor::none;
            for (int k = carry_left_ + 2 * half_width; k > 0; --k) {
                if (carry_left_ > 0) --carry_left_;
                last.angles = {of_block_.tilt + carried().tilt, of_block_.rotation + carried().rotation};
                put(last);
            }
        }
        return log_.finish();
    }

    [[nodiscard]] const std::vector<BlockExcess>& excesses() const { return excesses_; }
    /// The least ratio of limit to value; 1: no limit is exceeded.
    [[nodiscard]] double share() const { return share_; }

private:
    struct Sample {
        SimulatedPoint point;
        RotaryAngles angles;
        Vec3 ideal = Vec3::UnitZ();  ///< tool axis on the great circle of the block
        std::size_t block = 0;
    };

    void add(const SimulatedPoint& point) {
        Sample sample{point, {}, Vec3::UnitZ(), block_};
        bool changed = false;
        if (point.line > 0 && point.line <= blocks_->count()) {
            const std::size_t block = point.line - 1;
            changed = block != block_ && begun_;
            if (block != block_ || !begun_) {
                block_ = block;
                part_ = 0;
                begun_ = true;
                elapsed_ = 0;
                waiting_block_ = block;
                while (waiting_block_ > 0 && blocks_->stands(waiting_block_ - 1)) --waiting_block_;
            }
            sample.block = block;
            part_ = blocks_->waits(block) ? 0 : blocks_->part_at(block, point.commanded, part_);
        }
        if (begun_) {
            const auto [axis_path, part] =
                blocks_->waits(block_) ? turn_now() : std::pair(&blocks_->axis_path(block_), part_);
            of_block_ = axis_path->at(part);
            sample.angles = of_block_;
            if (changed && waiting_.size() > 1) {
                // Continues from the extrapolated angles.
                const RotaryAngles& a = waiting_[waiting_.size() - 2].angles;
                const RotaryAngles& b = waiting_.back().angles;
                carry_ = {2 * b.tilt - a.tilt - sample.angles.tilt,
                          2 * b.rotation - a.rotation - sample.angles.rotation};
                carry_left_ = carry_periods;
            }
            sample.angles = {sample.angles.tilt + carried().tilt, sample.angles.rotation + carried().rotation};
            if (carry_left_ > 0) --carry_left_;
            sample.ideal = great_circle(machine_->kinematics.axis_of(axis_path->at(0)),
                                        machine_->kinematics.axis_of(axis_path->at(1)), part);
        }
        float& peak = excesses_[sample.block].peak;
        peak = std::max(peak, static_cast<float>(point.speed));
        put(sample);
    }

    /// A rounded corner skips the end of one block and the start of the next one, with their change of the angles. The
    /// angles catch up over some periods. A step would not become smaller at lower speed.
    [[nodiscard]] RotaryAngles carried() const {
        const double part = static_cast<double>(carry_left_) / carry_periods;
        return {part * carry_.tilt, part * carry_.rotation};
    }

    /// Consecutive dwells are one for the planner, with the number of the last one. Returns the path of the current turn
    /// and the current part of it.
    std::pair<const ToolAxisPath*, double> turn_now() {
        elapsed_ += period_;
        while (waiting_block_ < block_ &&
               (!blocks_->waits(waiting_block_) || elapsed_ >= blocks_->waiting(waiting_block_))) {
            if (blocks_->waits(waiting_block_)) elapsed_ -= blocks_->waiting(waiting_block_);
            ++waiting_block_;
        }
        const double time = blocks_->waiting(waiting_block_);
        const double u = time > 0 ? std::min(1.0, elapsed_ / time) : 1.0;
        return {&blocks_->axis_path(waiting_block_), u * u * u * (10 + u * (6 * u - 15))};
    }

    void put(const Sample& sample) {
        if (waiting_.empty()) waiting_.assign(half_width, sample);  // before the first sample: at rest
        waiting_.push_back(sample);
        if (waiting_.size() < 2 * half_width) return;
        emit();
        waiting_.erase(waiting_.begin());
    }

    /// Outputs the middle one of the waiting samples, with the triangle-weighted mean of their angles.
    void emit() {
        const Sample& sample = waiting_[half_width];
        RotaryAngles angles{0, 0};
        for (int k = 1; k < 2 * half_width; ++k) {
            const double weight =
                static_cast<double>(half_width - std::abs(k - half_width)) / (half_width * half_width);
            const RotaryAngles& other = waiting_[static_cast<std::size_t>(k)].angles;
            angles.tilt += weight * other.tilt;
            angles.rotation += weight * other.rotation;
        }
        const Kinematics& kinematics = machine_->kinematics;
        const Vec3 linear = kinematics.to_axes(sample.point.commanded + blocks_->zero(), angles);
        FiveAxisPoint point;
        point.commanded = {linear.x(), linear.y(), linear.z(), angles.tilt, angles.rotation};
        point.speed = sample.point.speed;
        point.line = begun_ ? blocks_->line(sample.block) : 0;
        point.limit = sample.point.limit;
        if (point.limit == LimitingFactor::feed && blocks_->capped(sample.block))
            point.limit = LimitingFactor::axis_speed;
        if (begun_ && blocks_->cuts(sample.block)) {
            log_.note_orientation(angle_between(kinematics.axis_of(angles), sample.ideal));
        }
        log_.add(point,
                 [&](std::size_t axis, double value, double limit, int order) { hold(axis, value, limit, order); });
    }

    /// Marks blocks to be slowed down if a derivative of an axis (order 1 … 3) exceeds its limit. At half the speed, a
    /// whole run has an eighth of the jerk.
    void hold(std::size_t axis, double value, double limit, int order) {
        const double share = limit / value;
        share_ = std::min(share_, share);
        const double scale = order == 1 ? share : order == 2 ? std::sqrt(share) : std::cbrt(share);
        if (axis < 3 || order == 1) {
            // Any block that takes part in the smoothing may be the one that is too fast.
            for (const Sample& sample : waiting_) derate(sample.block, scale);
            return;
        }
        // Where blocks meet, the rate of an angle jumps by Δ. The smoothing turns that into an acceleration and a jerk in
        // proportion to Δ. The block with the higher rate is slowed down by the excess part of Δ. If the other blocks were
        // slowed down as well, the difference would remain and the jump would move from block to block.
        const auto rate = [&](std::size_t j) {
            const RotaryAngles& a = waiting_[j - 1].angles;
            const RotaryAngles& b = waiting_[j].angles;
            return axis == 3 ? b.tilt - a.tilt : b.rotation - a.rotation;
        };
        double low = rate(1);
        double high = low;
        for (std::size_t j = 2; j < waiting_.size(); ++j) {
            low = std::min(low, rate(j));
            high = std::max(high, rate(j));
        }
        const double greatest = std::max(std::abs(low), std::abs(high));
        const double jump = std::max(share, 1 - (1 - share) * (high - low) / greatest);
        for (std::size_t j = 1; j < waiting_.size(); ++j) {
            if (std::abs(rate(j)) >= nearly_greatest * greatest) derate(waiting_[j].block, std::min(scale, jump));
        }
    }
    void derate(std::size_t block, double scale) {
        excesses_[block].scale = std::min(excesses_[block].scale, static_cast<float>(scale));
    }

    const FiveAxisBlocks* blocks_;
    const Machine* machine_;
    double period_;
    std::vector<BlockExcess> excesses_;
    std::size_t block_ = 0;
    double part_ = 0;
    std::size_t waiting_block_ = 0;
    double elapsed_ = 0;  ///< since the start of the dwell [s]
    bool begun_ = false;
    RotaryAngles of_block_;  ///< of the last sample, without the angles that are carried
    RotaryAngles carry_;     ///< angles to catch up with at the last change of blocks
    int carry_left_ = 0;     ///< [periods]
    std::vector<Sample> waiting_;
    double share_ = 1;
    FiveAxisLog log_;
};

/// The machine for which the arc length of the tip is planned; its axes may have any orientation to the workpiece.
Machine machine_of_tip(const Machine& machine) {
    Machine tip = machine;
    MachineAxis least = machine.axes[0];
    const auto lower = [](double a, double b) { return a <= 0 ? b : b <= 0 ? a : std::min(a, b); };
    for (const MachineAxis& axis : machine.axes) {
        least.max_speed = std::min(least.max_speed, axis.max_speed);
        least.max_acceleration = std::min(least.max_acceleration, axis.max_acceleration);
        least.max_jerk = lower(least.max_jerk, axis.max_jerk);
    }
    least.travel_low = -infinite;
    least.travel_high = infinite;
    tip.axes.fill(least);
    return tip;
}

/// The planner of all axes divides acceleration ramps into cells; shorter ramps would need too many cells.
constexpr double shortest_resolved_ramp = 0.0005;  // s

/// The shortest time in which a jerk limit permits an axis or the path to reach its acceleration [s].
double shortest_ramp_of(const Machine& machine) {
    double ramp = machine.path.max_acceleration / machine.path.max_jerk;
    const auto shorten = [&](double acceleration, double jerk) {
        if (jerk > 0) ramp = std::min(ramp, acceleration / jerk);
    };
    for (const MachineAxis& axis : machine.axes) shorten(axis.max_acceleration, axis.max_jerk);
    for (const MachineAxis& axis : machine.rotary) shorten(axis.max_acceleration, axis.max_jerk);
    return ramp;
}

}  // namespace

FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start,
                                   const FiveAxisSink& sink, const Progress& progress) {
    FiveAxisBlocks blocks(program, machine, zero, start);
    // Planners whose corners have no continuous curvature plan the tip alone.
    const bool plans_tip = machine.controller.planner == PlannerKind::trapezoidal ||
                           machine.controller.corner == CornerMode::junction ||
                           shortest_ramp_of(machine) < shortest_resolved_ramp;
    if (!plans_tip) return run_five_axes(program, machine, std::move(blocks), start, sink, progress);
    Machine tip = machine_of_tip(machine);
    double share = 1;
    const auto run = [&](const FiveAxisSink& to, std::vector<BlockExcess>* excesses) {
        FiveAxisRecorder recorder(blocks, program, machine, to);
        const SimulationSummary planned = simulate(
            blocks.planned(), tip, start, [&](std::span<const SimulatedPoint> points) { recorder.add(points); },
            progress, Planning::by_nodes);
        FiveAxisSummary summary = recorder.finish();
        summary.run.path_deviation = planned.path_deviation;
        if (excesses != nullptr) *excesses = recorder.excesses();
        share = recorder.share();
        return summary;
    };
    std::vector<BlockExcess> excesses;
    int rounds = 0;
    for (bool slower = true; slower && rounds < most_slower_rounds; ++rounds) {
        const FiveAxisSummary tried = run({}, &excesses);
        slower = !tried.axes_ok && blocks.derate(excesses);
        // Between blocks of different speed the tip uses its whole jerk limit, however slow they are.
        if (slower && rounds >= patient_rounds) tip.path.max_jerk *= std::max(most_lowering, share);
    }
    FiveAxisSummary summary = run(sink, nullptr);
    summary.rounds = rounds;
    if (!summary.axes_ok) {
        summary.run.diagnostics.add(
            {Severity::warning, "motion.limits", Place::of_file(program.main().name()),
             fmt::format("after {} rounds an axis still exceeds a limit by more than 0.1 %", rounds),
             "a lower path jerk or feed helps"});
    }
    return summary;
}

}  // namespace clsurf

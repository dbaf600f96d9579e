#include "motion/five_axis_simulator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "motion/five_axis_blocks.h"
#include "motion/servo.h"

namespace clsurf {
namespace {

constexpr int most_rounds = 24;
constexpr double limit_play = 1.001;   ///< what counts as held, differentiated
constexpr int half_width = 8;          ///< of the smoothing of angles [periods]
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Takes the samples of the tip, and makes those of the axes.
class FiveAxisRecorder {
public:
    FiveAxisRecorder(const FiveAxisBlocks& blocks, const Program& program, const Machine& machine, const FiveAxisSink& sink)
        : blocks_(&blocks), program_(&program), machine_(&machine), sink_(&sink), period_(machine.controller.period),
          scales_(blocks.count(), 1.0F), peaks_(blocks.count(), 0.0F) {}

    void add(std::span<const SimulatedPoint> points) {
        for (const SimulatedPoint& point : points) add(point);
    }

    FiveAxisSummary finish() {
        // The angles come to rest after the tip.
        if (!waiting_.empty()) {
            for (int k = 0; k < half_width; ++k) {
                Sample last = waiting_.back();
                last.point.speed = 0;
                last.point.limit = Ruling::none;
                put(last);
            }
        }
        flush();
        summary_.run.points = points_;
        summary_.run.duration = static_cast<double>(std::max<PointIndex>(0, points_ - 1)) * period_;
        summary_.run.limits_ok = held_;
        return std::move(summary_);
    }

    [[nodiscard]] const std::vector<float>& scales() const { return scales_; }
    [[nodiscard]] const std::vector<float>& peaks() const { return peaks_; }

private:
    struct Sample {
        SimulatedPoint point;
        RotaryAngles angles;
        Vec3 ideal = Vec3::UnitZ();  ///< tool axis on the great circle of the block
        std::size_t block = 0;
    };

    void add(const SimulatedPoint& point) {
        Sample sample{point, {}, Vec3::UnitZ(), block_};
        if (point.line > 0 && point.line <= blocks_->count()) {
            const std::size_t block = point.line - 1;
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
            const auto [way, part] = blocks_->waits(block_) ? turn_now() : std::pair(&blocks_->way(block_), part_);
            sample.angles = way->at(part);
            sample.ideal = great_circle(machine_->kinematics.axis_of(way->at(0)), machine_->kinematics.axis_of(way->at(1)), part);
        }
        peaks_[sample.block] = std::max(peaks_[sample.block], static_cast<float>(point.speed));
        put(sample);
    }

    /// Waits that follow each other are one to the planner, with the number of the last: the way and part of it
    /// at which the wait now is.
    std::pair<const ToolAxisPath*, double> turn_now() {
        elapsed_ += period_;
        while (waiting_block_ < block_ && (!blocks_->waits(waiting_block_) || elapsed_ >= blocks_->waiting(waiting_block_))) {
            if (blocks_->waits(waiting_block_)) elapsed_ -= blocks_->waiting(waiting_block_);
            ++waiting_block_;
        }
        const double time = blocks_->waiting(waiting_block_);
        const double u = time > 0 ? std::min(1.0, elapsed_ / time) : 1.0;
        return {&blocks_->way(waiting_block_), u * u * u * (10 + u * (6 * u - 15))};
    }

    void put(const Sample& sample) {
        if (waiting_.empty()) waiting_.assign(half_width, sample);  // before the first, all stood there
        waiting_.push_back(sample);
        if (waiting_.size() < 2 * half_width) return;
        emit();
        waiting_.erase(waiting_.begin());
    }

    /// The sample in the middle of those waiting, with the mean of their angles under a triangle.
    void emit() {
        const Sample& sample = waiting_[half_width];
        RotaryAngles angles{0, 0};
        for (int k = 1 - half_width; k < half_width; ++k) {
            const double weight = static_cast<double>(half_width - std::abs(k)) / (half_width * half_width);
            const RotaryAngles& other = waiting_[static_cast<std::size_t>(half_width + k)].angles;
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
        if (point.limit == Ruling::feed && blocks_->capped(sample.block)) point.limit = Ruling::axis_speed;
        if (servos_.empty()) {
            last_.fill(point.commanded);
            for (std::size_t k = 0; k < 5; ++k) {
                const ServoModel& model = k < 3 ? machine_->axes[k].servo : machine_->rotary[k - 3].servo;
                servos_.emplace_back(model, period_, point.commanded[k], k + 1);
            }
        }
        for (std::size_t k = 0; k < 5; ++k) point.feedback[k] = servos_[k].follow(point.commanded[k]);
        if (begun_ && blocks_->cuts(sample.block)) {
            summary_.orientation_error = std::max(summary_.orientation_error, angle_between(kinematics.axis_of(angles), sample.ideal));
        }
        ++summary_.run.ruled[static_cast<std::size_t>(point.limit)];
        measure(point);
        ++points_;
        block_of_points_.push_back(point);
        if (static_cast<PointIndex>(block_of_points_.size()) == block_points) flush();
    }

    void measure(const FiveAxisPoint& point) {
        double scale = 1;
        const std::array<AxisLimits, 5>& limits = blocks_->limits();
        for (std::size_t k = 0; k < 5; ++k) {
            const double p = point.commanded[k];
            const double speed = std::abs(p - last_[0][k]) / period_;
            const double acceleration = std::abs(p - 2 * last_[0][k] + last_[1][k]) / (period_ * period_);
            const double jerk = std::abs(p - 3 * last_[0][k] + 3 * last_[1][k] - last_[2][k]) / (period_ * period_ * period_);
            const auto keep = [&](double value, double limit, double power) {
                if (value > limit * limit_play) scale = std::min(scale, std::pow(limit / value, power));
            };
            keep(speed, limits[k].speed, 1);
            keep(acceleration, limits[k].acceleration, 0.5);
            keep(jerk, limits[k].jerk, 1.0 / 3);
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
        if (scale == 1) return;
        held_ = false;
        // Whatever takes part in the smoothing may be what is too fast.
        for (const Sample& sample : waiting_) scales_[sample.block] = std::min(scales_[sample.block], static_cast<float>(scale));
    }

    void note_travel(std::size_t axis, double position, LineNumber line) {
        const AxisLimits& limits = blocks_->limits()[axis];
        const bool outside = position < limits.low || position > limits.high;
        if (outside && !outside_[axis]) {
            const double shown = axis < 3 ? 1.0 : deg_per_rad;
            const char letter = axis < 3 ? "xyz"[axis] : axis == 3 ? machine_->kinematics.tilt.letter : machine_->kinematics.rotation.letter;
            summary_.run.diagnostics.add({Severity::warning, "motion.travel", Place::of_line(program_->main().name(), line),
                                          fmt::format("{} leaves its travel of {:g} … {:g} {}", letter, limits.low * shown, limits.high * shown, axis < 3 ? "mm" : "deg"), {}});
        }
        outside_[axis] = outside;
    }

    void flush() {
        if (*sink_ && !block_of_points_.empty()) (*sink_)(block_of_points_);
        block_of_points_.clear();
    }

    const FiveAxisBlocks* blocks_;
    const Program* program_;
    const Machine* machine_;
    const FiveAxisSink* sink_;
    double period_;
    std::vector<float> scales_, peaks_;  ///< by block: what its speed must be multiplied by; its greatest speed [mm/s]
    std::size_t block_ = 0;
    double part_ = 0;
    std::size_t waiting_block_ = 0;
    double elapsed_ = 0;  ///< of its wait [s]
    bool begun_ = false;
    std::vector<Sample> waiting_;
    std::vector<ServoLoop> servos_;
    std::array<std::array<double, 5>, 3> last_{};
    std::array<bool, 5> outside_{};
    bool held_ = true;
    PointIndex points_ = 0;
    std::vector<FiveAxisPoint> block_of_points_;
    FiveAxisSummary summary_;
};

/// The machine that the tip's way is planned for: its axes may lie anyhow to those of the workpiece.
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

}  // namespace

FiveAxisSummary simulate_five_axis(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start, const FiveAxisSink& sink, const Progress& progress) {
    FiveAxisBlocks blocks(program, machine, zero, start);
    const Machine tip = machine_of_tip(machine);
    const auto run = [&](const FiveAxisSink& to, std::vector<float>* scales, std::vector<float>* peaks) {
        FiveAxisRecorder recorder(blocks, program, machine, to);
        const SimulationSummary of_tip = simulate(blocks.planned(), tip, start, [&](std::span<const SimulatedPoint> points) { recorder.add(points); }, progress, Planning::by_nodes);
        FiveAxisSummary summary = recorder.finish();
        summary.run.path_deviation = of_tip.path_deviation;
        if (scales != nullptr) *scales = recorder.scales();
        if (peaks != nullptr) *peaks = recorder.peaks();
        return summary;
    };
    std::vector<float> scales, peaks;
    int rounds = 0;
    for (bool slower = true; slower && rounds < most_rounds; ++rounds) {
        const FiveAxisSummary tried = run({}, &scales, &peaks);
        slower = !tried.run.limits_ok && blocks.ease(scales, peaks);
    }
    FiveAxisSummary summary = run(sink, nullptr, nullptr);
    summary.rounds = rounds;
    if (!summary.run.limits_ok) {
        summary.run.diagnostics.add({Severity::warning, "motion.limits", Place::of_file(program.main().name()),
                                     fmt::format("after {} rounds an axis still exceeds a limit by more than 0.1 %", rounds), "a lower path jerk or feed helps"});
    }
    return summary;
}

}  // namespace clsurf

#include "motion/simulator.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "motion/lookahead.h"
#include "motion/servo.h"

namespace clsurf {
namespace {

constexpr double limit_play = 1.001;   ///< what counts as held, differentiated
constexpr double same_instant = 1e-6;  ///< of a period: a stop this near after a sample falls on it

/// Counts what has been emitted and measures it.
class Recorder {
public:
    Recorder(const Program& program, const Machine& machine, const Vec3& start, const PointSink& sink)
        : program_(&program), machine_(&machine), sink_(&sink), period_(machine.controller.period) {
        for (std::size_t i = 0; i < 3; ++i) {
            servos_.emplace_back(machine.axes[i].servo, period_, start[static_cast<int>(i)], i + 1);
            last_.fill(start);
        }
        block_.reserve(static_cast<std::size_t>(block_points));
    }

    void add(const Vec3& position, double speed, LineNumber line, Ruling ruling, double deviation) {
        SimulatedPoint point{position, {}, speed, line, ruling};
        for (int i = 0; i < 3; ++i) point.feedback[i] = servos_[static_cast<std::size_t>(i)].follow(position[i]);
        block_.push_back(point);
        measure(position, line);
        summary_.path_deviation = std::max(summary_.path_deviation, deviation);
        ++summary_.ruled[static_cast<std::size_t>(ruling)];
        ++summary_.points;
        if (static_cast<PointIndex>(block_.size()) == block_points) flush();
    }

    SimulationSummary finish() {
        flush();
        summary_.duration = static_cast<double>(std::max<PointIndex>(0, summary_.points - 1)) * period_;
        const Machine& m = *machine_;
        bool ok = summary_.max_speed <= m.path.max_speed * limit_play;
        for (int i = 0; i < 3; ++i) {
            const MachineAxis& axis = m.axes[static_cast<std::size_t>(i)];
            ok = ok && summary_.max_axis_speed[i] <= axis.max_speed * limit_play;
            ok = ok && summary_.max_acceleration[i] <= axis.max_acceleration * limit_play;
            ok = ok && (axis.max_jerk <= 0 || summary_.max_jerk[i] <= axis.max_jerk * limit_play);
        }
        summary_.limits_ok = ok;
        return std::move(summary_);
    }

    [[nodiscard]] PointIndex points() const { return summary_.points; }
    SimulationSummary& summary() { return summary_; }

private:
    void flush() {
        (*sink_)(block_);
        block_.clear();
    }

    void measure(const Vec3& position, LineNumber line) {
        // Before the first point the axes stand at the start.
        const Vec3 speed = (position - last_[0]) / period_;
        const Vec3 acceleration = (position - 2 * last_[0] + last_[1]) / (period_ * period_);
        const Vec3 jerk = (position - 3 * last_[0] + 3 * last_[1] - last_[2]) / (period_ * period_ * period_);
        summary_.max_speed = std::max(summary_.max_speed, speed.norm());
        summary_.max_axis_speed = summary_.max_axis_speed.cwiseMax(speed.cwiseAbs());
        summary_.max_acceleration = summary_.max_acceleration.cwiseMax(acceleration.cwiseAbs());
        summary_.max_jerk = summary_.max_jerk.cwiseMax(jerk.cwiseAbs());
        last_ = {position, last_[0], last_[1]};
        for (int i = 0; i < 3; ++i) {
            const MachineAxis& axis = machine_->axes[static_cast<std::size_t>(i)];
            const bool outside = position[i] < axis.travel_low || position[i] > axis.travel_high;
            if (outside && !outside_[static_cast<std::size_t>(i)]) {
                summary_.diagnostics.add({Severity::warning, "motion.travel", Place::of_line(program_->main().name(), line),
                                          fmt::format("{} leaves its travel of {} … {} mm", axis_names[static_cast<std::size_t>(i)], axis.travel_low, axis.travel_high),
                                          "positions are those of the program: is the work offset not zero?"});
            }
            outside_[static_cast<std::size_t>(i)] = outside;
        }
    }

    const Program* program_;
    const Machine* machine_;
    const PointSink* sink_;
    double period_;
    std::vector<ServoLoop> servos_;
    std::vector<SimulatedPoint> block_;
    std::array<Vec3, 3> last_;
    std::array<bool, 3> outside_{};
    SimulationSummary summary_;
};

/// Runs the planned profiles against the clock of the interpolator.
class Interpolator {
public:
    Interpolator(double period, Recorder& recorder) : recorder_(&recorder), period_(period) {}

    [[nodiscard]] double next_sample() const { return static_cast<double>(recorder_->points()) * period_; }

    /// All samples that fall into a run, from its start on, its end not included.
    void run(const Run& run, std::span<const Span> spans) {
        const SCurve& profile = run.profile;
        const double end = time_ + profile.duration();
        const bool to_rest = run.end_speed == 0;
        std::size_t at = run.first;
        double before = 0;
        int phase = 0;
        for (double t = next_sample() - time_; time_ + t < end; t = next_sample() - time_) {
            while (phase < 6 && t >= profile.end_of(phase)) ++phase;
            const MotionState state = profile.in_phase(phase, t);
            while (at + 1 < run.last && state.way - before > spans[at].length) before += spans[at++].length;
            const Span& span = spans[at];
            const double tau = std::clamp(state.way - before, 0.0, span.length);
            double deviation = 0;
            double slope = 1;
            const Vec3 position = span.at(tau, deviation, slope);
            recorder_->add(position, state.speed * slope, span.base.line, ruling(run, span, phase, to_rest), deviation);
        }
        time_ = end;
        line_ = spans[run.last - 1].base.line;
    }

    /// At rest until `wait` seconds after the next sample.
    void rest(const Vec3& position, double wait, LineNumber line) {
        const auto stop = static_cast<PointIndex>(std::ceil(time_ / period_ - same_instant));
        const auto waiting = static_cast<PointIndex>(std::ceil(wait / period_ - same_instant));
        for (PointIndex last = stop + std::max<PointIndex>(0, waiting); recorder_->points() < last;) {
            recorder_->add(position, 0, line > 0 ? line : line_, Ruling::none, 0);
        }
        time_ = static_cast<double>(stop + std::max<PointIndex>(0, waiting)) * period_;
    }
    [[nodiscard]] LineNumber line() const { return line_; }

private:
    [[nodiscard]] Ruling ruling(const Run& run, const Span& span, int phase, bool to_rest) const {
        if (phase == 3) return span.ruling;
        if (to_rest && phase > 3) return Ruling::lookahead_end;
        // An eased run keeps its acceleration low for the jerk that it costs in bends.
        return (phase == 1 || phase == 5) && !run.eased ? Ruling::axis_acceleration : Ruling::jerk;
    }

    Recorder* recorder_;
    double period_;
    double time_ = 0;
    LineNumber line_ = 0;
};

/// The window of spans that is planned, and how much of the plan is run before it is planned again.
class Controller {
public:
    Controller(const Machine& machine, PathStream& stream, Interpolator& interpolator)
        : blocks_(machine.controller.lookahead_blocks), stream_(&stream), interpolator_(&interpolator), planner_(machine) {}

    /// Runs a section, from rest to rest.
    template <typename Report>
    void run_section(const Report& report) {
        window_.clear();
        pending_.clear();
        double speed = 0;
        bool ended = false;
        while (true) {
            Span span;
            while (!ended && (window_.empty() || window_.back().block - window_.front().block < blocks_)) {
                if (stream_->next(span)) window_.push_back(span);
                else ended = true;
            }
            if (window_.empty()) return;
            // Half of the window is run, the other half is what it looks ahead.
            std::size_t half = window_.size();
            std::vector<std::size_t> nodes;
            if (!ended) {
                const std::int64_t middle = window_.front().block + std::max(1, blocks_ / 2);
                half = 1;
                while (half + 1 < window_.size() && window_[half].block < middle) ++half;
                nodes.push_back(half);
            }
            std::size_t done = 0;
            if (planner_.plan(window_, speed, nodes)) {
                pending_ = planner_.runs();
                while (!pending_.empty() && pending_.front().last <= half) run_first(speed, done);
            } else {
                // The plan before goes on: it ends at rest, whatever comes after.
                run_first(speed, done);
            }
            window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(done));
            for (Run& run : pending_) run.first -= done, run.last -= done;
            report();
        }
    }

private:
    void run_first(double& speed, std::size_t& done) {
        interpolator_->run(pending_.front(), window_);
        speed = pending_.front().end_speed;
        done = pending_.front().last;
        pending_.erase(pending_.begin());
    }

    int blocks_;
    PathStream* stream_;
    Interpolator* interpolator_;
    WindowPlanner planner_;
    std::vector<Span> window_;
    std::vector<Run> pending_;
};

}  // namespace

SimulationSummary simulate(const Program& program, const Machine& machine, const Vec3& start,
                           const PointSink& sink, const Progress& progress) {
    PathStream stream(program, machine, start);
    const Vec3 from = stream.position();
    Recorder recorder(program, machine, from, sink);
    Interpolator interpolator(machine.controller.period, recorder);
    Controller controller(machine, stream, interpolator);
    const auto report = [&] {
        if (progress) progress("plan and interpolate", static_cast<double>(stream.motions_taken()) / static_cast<double>(std::max<std::int64_t>(1, program.motions.size())));
    };
    Vec3 at = from;
    while (stream.begin_section()) {
        controller.run_section(report);
        at = stream.section_end();
        interpolator.rest(at, stream.dwell(), stream.dwell_line());
    }
    recorder.add(at, 0, interpolator.line(), Ruling::none, 0);
    return recorder.finish();
}

}  // namespace clsurf

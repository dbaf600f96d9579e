#include "simulation/run/simulator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "simulation/path/junction.h"
#include "simulation/plan/lookahead.h"
#include "simulation/plan/lookahead_window.h"
#include "simulation/plan/refiner.h"
#include "simulation/plan/scan_driver.h"
#include "simulation/run/interpolator.h"
#include "simulation/run/recorder.h"
#include "simulation/run/trapezoid_simulator.h"

namespace clsurf {
namespace {

/// The window of spans that is planned. A part of the plan is run before the window is planned again.
class Controller {
public:
    // The known blocks are divided between the plan and its refinement.
    Controller(const Machine& machine, PathStream& stream, Interpolator& interpolator, Planning planning)
        : known_(machine.controller, planning == Planning::by_nodes ? machine.controller.lookahead_blocks
                                                                    : (machine.controller.lookahead_blocks + 1) / 2),
          stream_(&stream),
          planner_(machine, planning == Planning::nearly_optimal),
          refiner_(machine, interpolator,
                   planning == Planning::by_nodes ? 0 : std::max(1, machine.controller.lookahead_blocks / 2)) {}

    /// Runs a section from rest to rest.
    void run_section(const std::function<void()>& report) {
        window_.clear();
        pending_.clear();
        double speed = 0;
        bool ended = false;
        while (true) {
            known_.begin(window_.items());
            while (!ended && (window_.empty() || known_.takes_more(window_.front(), window_.back()))) {
                if (const Span* span = stream_->next()) {
                    window_.push_back(*span);
                    known_.count(window_.front(), *span);
                } else {
                    ended = true;
                }
            }
            if (window_.empty()) return;
            // A part of the window is run; the rest is the look-ahead.
            std::size_t half = window_.size();
            std::vector<std::size_t> nodes;
            if (!ended) {
                const std::int64_t kept = known_.first_kept(window_.front(), window_.back());
                half = 1;
                while (half + 1 < window_.size() && window_[half].base.block < kept) ++half;
                nodes.push_back(half);
            }
            std::size_t ran = 0, done = 0;  // runs, spans
            if (planner_.plan(window_.items(), speed, nodes)) {
                pending_ = planner_.runs();
                while (ran < pending_.size() && pending_[ran].last <= half) run(pending_[ran++], speed, done);
            } else if (pending_.empty()) {
                throw std::logic_error(fmt::format("no plan exists from {} mm/s in the block of line {}", speed,
                                                   window_.front().base.line));
            } else {
                // The previous plan continues: it ends at rest, independent of the following blocks.
                run(pending_[ran++], speed, done);
            }
            for (std::size_t i = 0; i < done; ++i) window_.pop_front();
            pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(ran));
            for (SpeedRun& left : pending_) left.first -= done, left.last -= done;
            report();
        }
    }

private:
    void run(const SpeedRun& next, double& speed, std::size_t& done) {
        refiner_.push(next, window_.items().subspan(next.first, next.last - next.first));
        speed = next.end_speed;
        done = next.last;
    }

    LookaheadWindow known_;
    PathStream* stream_;
    WindowPlanner planner_;
    Refiner refiner_;
    Queue<Span> window_;
    std::vector<SpeedRun> pending_;
};

}  // namespace

SimulationSummary simulate(const Program& program, const Machine& machine, const Vec3& start, const PointSink& sink,
                           const Progress& progress, Planning planning) {
    WholeProgram whole(program);
    return simulate(whole, machine, start, sink, progress, planning);
}

SimulationSummary simulate(MotionSource& source, const Machine& machine, const Vec3& start, const PointSink& sink,
                           const Progress& progress, Planning planning) {
    if (machine.controller.planner == PlannerKind::trapezoidal)
        return simulate_trapezoids(source, machine, start, sink, progress);
    const bool scans = planning == Planning::nearly_optimal && jerks_freely(machine);
    // If axis speeds step at corners, acceleration cannot be carried through them.
    if (machine.controller.corner == CornerMode::junction) planning = Planning::by_nodes;
    PathStream stream(source, machine, start);
    const Vec3 from = stream.blocks().position();
    Recorder recorder(source.program(), machine, from, sink);
    Interpolator interpolator(machine.controller.period, recorder);
    Controller controller(machine, stream, interpolator, planning);
    ScanDriver scan(machine, stream, interpolator);
    const auto report = [&] {
        if (progress) progress("plan and interpolate", stream.blocks().done());
    };
    Vec3 at = from;
    while (stream.begin_section()) {
        if (scans)
            scan.run_section(report);
        else
            controller.run_section(report);
        at = stream.blocks().section_end();
        interpolator.rest(at, stream.blocks().dwell(), stream.blocks().dwell_line());
    }
    recorder.add(at, 0, interpolator.line(), LimitingFactor::none, 0);
    return recorder.finish();
}

}  // namespace clsurf

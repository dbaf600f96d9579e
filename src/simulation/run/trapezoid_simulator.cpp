#include "simulation/run/trapezoid_simulator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "simulation/path/block_merging.h"
#include "simulation/path/spline_sections.h"
#include "simulation/plan/segment_queue.h"
#include "simulation/plan/segment_runner.h"
#include "simulation/run/recorder.h"

namespace clsurf {
namespace {

/// The set points of the axes. With cubic interpolation they are the joints of a cubic B-spline over the planned points,
/// (p₋₁ + 4 p + p₊₁)/6, one period later.
class SetPoints {
public:
    SetPoints(const Machine& machine, Recorder& recorder, const Vec3& start)
        : recorder_(&recorder), smooth_(machine.controller.trapezoid.cubic_interpolation) {
        before_.position = last_.position = start;
    }

    void add(const PlannedPoint& point) {
        if (!smooth_) {
            write(point, point.position);
        } else if (std::exchange(begun_, true)) {
            write_between(point);
        }
        before_ = last_;
        last_ = point;
    }
    /// Writes the point that waits for the next one.
    void finish() {
        if (smooth_ && begun_) write_between(last_);
        begun_ = false;
    }
    /// The point that is farthest from a path without tolerance.
    [[nodiscard]] const PlannedPoint& untolerated() const { return untolerated_; }

private:
    void write_between(const PlannedPoint& next) {
        PlannedPoint point = last_;
        point.line = next.line;  // line of the newest point involved
        write(point, (before_.position + 4 * last_.position + next.position) / 6);
    }
    void write(const PlannedPoint& point, const Vec3& position) {
        if (!point.tolerated && point.deviation > untolerated_.deviation) untolerated_ = point;
        recorder_->add(position, point.speed, point.line, point.limiting, point.deviation);
    }

    Recorder* recorder_;
    bool smooth_, begun_ = false;
    PlannedPoint before_, last_, untolerated_;
};

/// `G64` without P: LinuxCNC rounds corners by up to a quarter of the shorter block.
Diagnostic no_tolerance(const Program& program, const PlannedPoint& point) {
    return {Severity::warning, "motion.no-tolerance", Place::of_line(program.main().name(), point.line),
            fmt::format("no tolerance is set here: corners leave the path by up to {:.4f} mm", point.deviation),
            "G64 without P rounds as much as the speed needs; G64 P sets a tolerance"};
}

}  // namespace

SimulationSummary simulate_trapezoids(MotionSource& source, const Machine& machine, const Vec3& start,
                                      const PointSink& sink, const Progress& progress) {
    BlockStream blocks(source, machine, start, Stops::programmed);
    SplineSections sections(blocks);
    BlockMerging merged(sections);
    const Vec3 from = blocks.position();
    Recorder recorder(source.program(), machine, from, sink);
    SetPoints points(machine, recorder, from);
    SegmentQueue queue(machine);
    SegmentRunner runner(queue, machine, from);
    // Twice the reach of a backward scan: the end of a block no longer changes when it runs.
    const std::size_t known = 2 * static_cast<std::size_t>(machine.controller.lookahead_blocks) + 4;
    PlannedPoint point;
    point.position = from;
    // The axes are at rest for one period before the first point, so that the spline begins at their position.
    points.add(point);
    points.add(point);
    PathElement element;
    while (blocks.begin_section()) {
        bool ended = false;
        while (true) {
            for (int i = 0; i < machine.controller.trapezoid.blocks_per_period && !ended && queue.size() < known; ++i) {
                ended = !merged.next(element);
                if (!ended) queue.add(element);
            }
            if (!runner.run(point)) break;
            points.add(point);
            if (progress && recorder.points() % 1024 == 0) progress("plan and interpolate", blocks.done());
        }
        point.position = blocks.section_end();
        runner.stand_at(point.position);
        point.speed = point.deviation = 0;
        point.limiting = LimitingFactor::none;
        if (blocks.dwell_line() > 0) point.line = blocks.dwell_line();
        const auto waiting = static_cast<PointIndex>(std::ceil(blocks.dwell() / machine.controller.period - 1e-6));
        for (PointIndex i = 0; i < waiting; ++i) points.add(point);
    }
    points.add(point);
    points.finish();
    SimulationSummary summary = recorder.finish();
    if (points.untolerated().deviation > machine.controller.tolerance)
        summary.diagnostics.add(no_tolerance(source.program(), points.untolerated()));
    return summary;
}

}  // namespace clsurf

#pragma once
// ScanDriver: runs sections of a path on a machine without a jerk limit, with SpeedScan.
//
// The spans of a window of blocks are divided into cells. Half of the window is run, then it is planned again. If a plan
// exceeds a limit between the places of a cell, that limit is added and the plan is made again. The cells do not change
// otherwise, and each plan satisfies the limits at the same places and ends at rest. Therefore the last plan can always be
// continued.

#include <deque>
#include <functional>
#include <vector>

#include "simulation/path/path_stream.h"
#include "simulation/plan/planned_motion.h"
#include "simulation/plan/speed_scan.h"

namespace clsurf {

class ScanDriver {
public:
    /// All references must outlive the object.
    ScanDriver(const Machine& machine, PathStream& stream, MotionSink& sink)
        : machine_(&machine), stream_(&stream), sink_(&sink) {}

    /// Runs a section from rest to rest; `report` is called after each part of it.
    void run_section(const std::function<void()>& report);

private:
    /// The place of a cell of the scan on a span.
    struct Cell {
        const Span* span = nullptr;
        double from = 0;  ///< on the span [mm]
        LimitingFactor at_cap = LimitingFactor::none;
        double length = 0;      ///< [mm]
        std::size_t parts = 0;  ///< number of equal parts, at whose ends the limits are checked; 0: no check is needed
    };

    [[nodiscard]] bool take_span();
    [[nodiscard]] bool gentle(const Span& span) const;
    [[nodiscard]] Vec3 curving(const Span& span) const;
    void divide(const Span& span);
    void add_cell(Cell cell, const Vec3& accelerations);
    void limit_path(const Span& span, double part);
    void limit_path_at(std::size_t cell, double at, const PathDerivatives& place, double part, double acceleration);
    void plan(double speed);
    [[nodiscard]] bool limit_between();
    [[nodiscard]] bool holds(std::size_t cell, double at, const PathDerivatives& place) const;
    void run(std::size_t count);

    const Machine* machine_;
    PathStream* stream_;
    MotionSink* sink_;
    std::deque<Span> spans_;   ///< of the window
    std::vector<Cell> cells_;  ///< cells of scan_
    SpeedScan scan_;
    // Scratch: the places of a cell from start to end, and its motions.
    std::vector<PathDerivatives> places_;
    std::vector<CellMotion> motions_;
};

}  // namespace clsurf

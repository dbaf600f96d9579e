#pragma once
// SegmentRunner: runs the queue of the trapezoidal planner, one period at a time. Speeds change by constant
// accelerations; a segment that ends within a period leaves the rest of the period to the next one.

#include "simulation/path/path_stream.h"
#include "simulation/plan/segment_queue.h"

namespace clsurf {

/// A set point with its data.
struct PlannedPoint {
    Vec3 position = Vec3::Zero();  ///< [mm]
    double speed = 0;              ///< [mm/s]
    double deviation = 0;          ///< from the programmed path [mm]
    bool tolerated = true;         ///< the program or the machine defines a tolerance there
    LineNumber line = 0;
    LimitingFactor limiting = LimitingFactor::none;
};

class SegmentRunner {
public:
    /// Both references must outlive the object. `position`: of the axes at the start.
    SegmentRunner(SegmentQueue& queue, const Machine& machine, const Vec3& position);

    /// Runs the next period. False: the queue is empty and nothing moves.
    [[nodiscard]] bool run(PlannedPoint& point);
    [[nodiscard]] const Vec3& position() const { return position_; }
    /// Corrects differences of rounding size to the program's position.
    void stand_at(const Vec3& position) { position_ = position; }

private:
    /// The acceleration in a period, and the highest speed from which braking reaches the segment's end.
    struct Step {
        double acceleration = 0, speed = 0;
    };

    void activate(BlendSegment& segment) const;
    void update(BlendSegment& segment, const BlendSegment* next);
    [[nodiscard]] Step trapezoid(const BlendSegment& segment, const BlendSegment* next) const;
    [[nodiscard]] bool ramp(const BlendSegment& segment, const BlendSegment* next, Step& step) const;
    void look_for_end(BlendSegment& segment, const BlendSegment* next) const;
    void finish(BlendSegment& segment, BlendSegment* next);
    void run_whole(BlendSegment& segment, BlendSegment* next);
    [[nodiscard]] const BlendSegment& reported(const BlendSegment& segment, const BlendSegment* next, bool ended) const;
    [[nodiscard]] LimitingFactor limiting_of(const BlendSegment& segment) const;
    [[nodiscard]] double deviation_of(const BlendSegment& segment) const;
    void measure(const BlendSegment& segment, const BlendSegment* next, const BlendSegment& shown,
                 PlannedPoint& point) const;

    SegmentQueue* queue_;
    const Machine* machine_;
    double period_;
    Vec3 position_;
    double overlap_speed_ = 0;  ///< speed of the next segment while it overlaps the present one [mm/s]
};

}  // namespace clsurf

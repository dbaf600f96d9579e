#pragma once
// SegmentQueue: the blocks that the trapezoidal planner knows ahead. A new block decides how the one before it ends, and
// a scan from the back finds the speeds at which the segments can end.

#include "core/queue.h"
#include "simulation/plan/blend_segment.h"

namespace clsurf {

/// Speeds of two segments while they overlap (a parabolic blend), and what it is worth.
struct OverlapSpeeds {
    double before = 0, after = 0;  ///< [mm/s]
    double along = 0;              ///< in the direction between both [mm/s]
};

/// Of a segment and the next with the speeds that are wanted on them [mm/s]: each keeps to half of the acceleration, to
/// half of its length, and inside the tolerance at the corner.
[[nodiscard]] OverlapSpeeds overlap_speeds(const BlendSegment& before, const BlendSegment& after, double speed_before,
                                           double speed_after);

class SegmentQueue {
public:
    explicit SegmentQueue(const Machine& machine) : machine_(&machine) {}

    /// Takes the next block, which begins where the one before it ends.
    void add(const PathElement& element);
    [[nodiscard]] bool empty() const { return segments_.empty(); }
    [[nodiscard]] std::size_t size() const { return segments_.size(); }
    [[nodiscard]] BlendSegment& operator[](std::size_t i) { return segments_[i]; }
    void pop_front() { segments_.pop_front(); }

    /// The highest speed that a segment can be asked for, with any override [mm/s].
    [[nodiscard]] double greatest_speed(const BlendSegment& segment) const;
    /// The speed that it is asked for [mm/s].
    [[nodiscard]] double target_speed(const BlendSegment& segment) const;
    /// The speed at its end: 0 unless it is tangent to the next [mm/s].
    [[nodiscard]] double target_end_speed(const BlendSegment& segment, const BlendSegment* next) const;

private:
    enum class Junction : std::uint8_t { settled, open };

    [[nodiscard]] Junction join(BlendSegment& before, BlendSegment& after) const;
    void blend(BlendSegment& after);
    void scan_back();
    void limit_end(BlendSegment& before, BlendSegment& segment) const;

    const Machine* machine_;
    Queue<BlendSegment> segments_;
};

}  // namespace clsurf

#pragma once
// SegmentQueue: the blocks that the trapezoidal planner knows in advance. A new block decides how the previous block ends,
// and a backward scan finds the speeds at which the segments can end.

#include "core/queue.h"
#include "simulation/plan/blend_segment.h"

namespace clsurf {

/// Speeds of two segments while they overlap (a parabolic blend), and the resulting speed.
struct OverlapSpeeds {
    double before = 0, after = 0;  ///< [mm/s]
    double along = 0;              ///< in the mean direction of both [mm/s]
};

/// The blend of a segment and the next one at the requested speeds [mm/s]: each uses at most half of the acceleration and
/// half of its length, and the blend stays within the tolerance at the corner.
[[nodiscard]] OverlapSpeeds overlap_speeds(const BlendSegment& before, const BlendSegment& after, double speed_before,
                                           double speed_after);

class SegmentQueue {
public:
    explicit SegmentQueue(const Machine& machine) : machine_(&machine) {}

    /// Adds the next block, which begins where the previous one ends.
    void add(const PathElement& element);
    [[nodiscard]] bool empty() const { return segments_.empty(); }
    [[nodiscard]] std::size_t size() const { return segments_.size(); }
    [[nodiscard]] BlendSegment& operator[](std::size_t i) { return segments_[i]; }
    void pop_front() { segments_.pop_front(); }

    /// The highest speed that can be requested of a segment, at any override [mm/s].
    [[nodiscard]] double greatest_speed(const BlendSegment& segment) const;
    /// The requested speed [mm/s].
    [[nodiscard]] double target_speed(const BlendSegment& segment) const;
    /// The speed at its end: 0 unless it is tangent to the next segment [mm/s].
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

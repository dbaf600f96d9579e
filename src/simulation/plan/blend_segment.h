#pragma once
// BlendSegment: a block, or the arc between two blocks, in the queue of the trapezoidal planner (segment_queue.h),
// with the limits that follow from its direction and shape.

#include "core/geometry.h"
#include "machine/machine.h"
#include "simulation/path/path_element.h"

namespace clsurf {

/// How a segment passes into the next one.
enum class SegmentEnd : std::uint8_t {
    parabolic,  ///< the next one accelerates while this one brakes
    tangent,    ///< at speed: the directions agree, or the step between them costs little acceleration
    exact,      ///< at rest, unless the directions agree
    stop,       ///< at rest
};

struct BlendSegment {
    PathElement path;  ///< if a line is consumed by its arc: the arc
    Vec3 lead_tangent = Vec3::Zero();
    double lead = 0;                ///< straight section before the arc: the rest of a consumed line [mm]
    bool blend = false;             ///< an arc between two blocks
    double length = 0;              ///< including the lead [mm]
    double nominal_length = 0;      ///< before blends shortened it [mm]
    double tolerance = 0;           ///< at its corners [mm]; 0: none
    double feed = 0;                ///< programmed, or the speed of a rapid [mm/s]
    double max_speed = 0;           ///< [mm/s]
    double max_acceleration = 0;    ///< [mm/s²]
    double tangential_share = 0.5;  ///< share of the acceleration that is used along an arc
    SegmentEnd end = SegmentEnd::parabolic;
    bool rapid = false;
    bool blended_before = false;             ///< a parabolic blend leads into it
    bool final_length = false;               ///< no later block shortens it any more
    double junction_speed = -1;              ///< at a tangent end [mm/s]; negative: not limited
    double step_after = 0, step_before = 0;  ///< shares of the acceleration that direction steps at the ends use
    double final_speed = 0;                  ///< speed at its end that the following segments allow [mm/s]

    // The motion.
    double progress = 0, speed = 0;  ///< [mm], [mm/s]
    double cycle = 0;                ///< time of its next update [s]
    double end_speed = 0;            ///< if it ends within the next period [mm/s]
    double speed_at_blend = 0, blend_speed = 0;
    bool active = false, ramp = false, braking = false, blending_next = false, overlapped = false;
    bool ends_now = false;  ///< within the next period
    bool done = false;
    bool at_limit = false;  ///< more look-ahead cannot raise its final speed

    [[nodiscard]] Vec3 at(double distance) const;
    [[nodiscard]] double to_go() const { return length - progress; }
    [[nodiscard]] Vec3 start_tangent() const;
    [[nodiscard]] Vec3 end_tangent() const;
    [[nodiscard]] bool curved() const { return path.arc; }
    /// Angle of an arc [rad].
    [[nodiscard]] double sweep() const { return path.length * path.rate; }
    /// The acceleration minus the share of direction steps; half of that if segments overlap [mm/s²].
    [[nodiscard]] double acceleration() const;
    /// Acceleration along the path; lower on arcs, which need a share for the normal acceleration [mm/s²].
    [[nodiscard]] double tangential_acceleration() const;
    /// Limits the speed so that the segment takes at least the shortest time [mm/s].
    void limit_speed_by_length(double shortest_time);
    /// Called when the length is final. Divides the acceleration of an arc into a normal and a tangential share at its
    /// highest speed.
    void finish_length(double period);
};

/// The segment of a block, with the limits that its axes impose.
[[nodiscard]] BlendSegment segment_of(const PathElement& element, const Machine& machine);

/// Half of the interior angle between two unit directions: π/2 straight on, 0 at a reversal [rad].
[[nodiscard]] double half_corner_angle(const Vec3& in, const Vec3& out);

/// The share of the normal acceleration if half of the acceleration is used along an arc: √3/2.
inline constexpr double normal_share = 0.86602540378443864676;

}  // namespace clsurf

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
    PathElement path;  ///< of a consumed line and its arc: the arc
    Vec3 lead_tangent = Vec3::Zero();
    double lead = 0;                ///< straight run before the arc: what remains of a consumed line [mm]
    bool blend = false;             ///< an arc between two blocks
    double length = 0;              ///< with the lead [mm]
    double nominal_length = 0;      ///< before blends took their parts [mm]
    double tolerance = 0;           ///< of its corners [mm]; 0: none
    double feed = 0;                ///< programmed, or the speed of a rapid [mm/s]
    double max_speed = 0;           ///< [mm/s]
    double max_acceleration = 0;    ///< [mm/s²]
    double tangential_share = 0.5;  ///< of the acceleration, along an arc
    SegmentEnd end = SegmentEnd::parabolic;
    bool rapid = false;
    bool blended_before = false;             ///< a parabolic blend leads into it
    bool final_length = false;               ///< no later block shortens it
    double junction_speed = -1;              ///< at its tangent end [mm/s]; negative: not limited
    double step_after = 0, step_before = 0;  ///< shares of the acceleration that steps of direction at its ends use
    double final_speed = 0;                  ///< that what follows allows at its end [mm/s]

    // The motion.
    double progress = 0, speed = 0;  ///< [mm], [mm/s]
    double cycle = 0;                ///< time of its next update [s]
    double end_speed = 0;            ///< when it ends inside the next period [mm/s]
    double speed_at_blend = 0, blend_speed = 0;
    bool active = false, ramp = false, braking = false, blending_next = false, overlapped = false;
    bool ends_now = false;  ///< inside the next period
    bool done = false;
    bool at_limit = false;  ///< its final speed is as high as any look-ahead lets it be

    [[nodiscard]] Vec3 at(double distance) const;
    [[nodiscard]] double to_go() const { return length - progress; }
    [[nodiscard]] Vec3 start_tangent() const;
    [[nodiscard]] Vec3 end_tangent() const;
    [[nodiscard]] bool curved() const { return path.arc; }
    /// Angle of an arc [rad].
    [[nodiscard]] double sweep() const { return path.length * path.rate; }
    /// What is left of the acceleration beside steps of direction; half of it where segments overlap [mm/s²].
    [[nodiscard]] double acceleration() const;
    /// Along the path; on arcs less, for what is normal to it [mm/s²].
    [[nodiscard]] double tangential_acceleration() const;
    /// Not more than one period's distance a period [mm/s].
    void limit_speed_by_length(double shortest_time);
    /// The length is final: the acceleration of an arc is shared between the directions at its highest speed.
    void finish_length(double period);
};

/// A segment of a block, with the limits of its axes.
[[nodiscard]] BlendSegment segment_of(const PathElement& element, const Machine& machine);

/// Half of the interior angle between two unit directions: π/2 straight on, 0 reversal [rad].
[[nodiscard]] double half_corner_angle(const Vec3& in, const Vec3& out);

/// The normal acceleration that goes with half of the acceleration along an arc: √3/2 of all.
inline constexpr double normal_share = 0.86602540378443864676;

}  // namespace clsurf

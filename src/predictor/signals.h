#pragma once
// Signals: what is compared between adjacent passes, once for every logged point: speed, feed
// direction, acceleration, and two heights along the surface normal. Everything is smoothed over a
// stated window inside one piece of the path, never across a link.

#include <string>
#include <vector>

#include "numeric/derivative.h"
#include "surface/cl_surface.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Where on a pass a point lies.
enum class Zone : std::uint8_t {
    outside,   ///< not on a cut pass, or next to where a pass begins or ends: not compared
    ramp,      ///< the tool still speeds up from the pass's beginning, or slows down to its end
    near_end,  ///< as near to an end as ramps are found, but it does neither
    inner,     ///< the pass goes on
};

/// What is known of a point, side by side: whoever compares passes looks at all of it at once, on a
/// dozen passes at a time, and pays for every cache line.
struct Sample {
    float speed;   ///< [mm/s] of the surface's own positions
    float lag;     ///< [mm] how far the measured path runs above (+) the commanded one, along the normal; NaN: none
    float relief;  ///< [mm] how far the point lies above the chord between its neighbours, along the normal
    float acceleration[3];  ///< [mm/s²]
    float feed[3];          ///< unit vector; NaN where the tool stands
    float normal[3];        ///< unit vector of the CL surface, feed × (left − right); NaN: no neighbour
    Zone zone;
};

[[nodiscard]] inline Eigen::Map<const Eigen::Vector3f> vector_of(const float (&v)[3]) {
    return Eigen::Map<const Eigen::Vector3f>(v);
}

struct Signals {
    Column<Sample> samples;  ///< one per point
    bool measured = false;   ///< there is a lag
    float quantum = 0;       ///< [mm] coarsest step in which the positions come; 0: none seen
    /// What the rounding of the positions alone makes of two passes, at most: differences of speed [mm/s] and
    /// acceleration [mm/s²] along an axis.
    float speed_noise = 0, acceleration_noise = 0;
    std::vector<PointRange> pieces;  ///< of the path, between which nothing is smoothed: they end where passes do
    std::vector<std::string> unfit;  ///< why the data cannot show marks, as sentences; empty: they can
    std::string speed_note, acceleration_note, height_note;  ///< the windows, "speed over 11 points (11 ms)"

    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(samples.size()); }
    [[nodiscard]] const Sample& operator[](PointIndex i) const { return samples[static_cast<std::size_t>(i)]; }
    [[nodiscard]] Sample& operator[](PointIndex i) { return samples[static_cast<std::size_t>(i)]; }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> feed(PointIndex i) const { return vector_of((*this)[i].feed); }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> acceleration(PointIndex i) const {
        return vector_of((*this)[i].acceleration);
    }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> normal(PointIndex i) const { return vector_of((*this)[i].normal); }
};

/// How much [mm] of the ends of passes is not judged by default: what the tool does there, it does on
/// every pass.
[[nodiscard]] double usual_end_zone(double step_over);

/// `path` is what `surface` was gathered from; `measured` the feedback or actual positions, or nullptr.
/// `pieces` (surface/smoothing_segments.h) bound the windows. `end_zone` [mm] at the ends of pieces is outside.
/// O(points), parallel.
///
/// The lag is where the measured path crosses the plane through the commanded point normal to the
/// feed: a lag *along* the path, which says nothing about the surface, drops out.
///
/// `estimate`: speeds and accelerations are those of a Kalman smoother; nullptr: of least squares over windows.
[[nodiscard]] Signals derive_signals(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                                     const std::vector<PointRange>& pieces, double end_zone,
                                     const MotionEstimate* estimate = nullptr);

}  // namespace clsurf

#pragma once
// Signals: what is compared between adjacent passes, once for every logged point: speed, feed
// direction, acceleration, and two heights along the surface normal. Everything is smoothed over a
// stated window inside one piece of the path, never across a link.

#include <memory>
#include <string>
#include <vector>

#include "core/block_fill.h"
#include "core/column.h"
#include "numeric/derivative.h"
#include "predictor/sample.h"
#include "surface/cl_surface.h"
#include "toolpath/arc_length.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct Signals {
    Column<Sample> samples;  ///< one per point
    bool measured = false;   ///< there is a lag
    float quantum = 0;       ///< [mm] coarsest step in which the positions come; 0: none seen
    /// The largest differences that the rounding of positions alone causes between two passes: of speed [mm/s] and of
    /// acceleration [mm/s²] along an axis.
    float speed_noise = 0, acceleration_noise = 0;
    float speed_step_response =
        0;  ///< [1/s] largest filtered acceleration at a step of the speed, divided by that step
    std::vector<PointRange> pieces;  ///< of the path; nothing is smoothed across their ends, which are ends of passes
    std::vector<std::string> unfit;  ///< why the data cannot show marks, as sentences; empty: they can
    std::string speed_note, acceleration_note, height_note;  ///< the windows, "speed over 11 points (11 ms)"
    /// For signals that are derived when they are read, each stage from the one before; else nullptr. Code that reads `samples`
    /// directly must request them first.
    BlockFillPointer motion, zones, heights;
    std::shared_ptr<ArcLength> arc_length;  ///< arc length of these signals, used to derive zones

    [[nodiscard]] PointIndex size() const { return static_cast<PointIndex>(samples.size()); }
    [[nodiscard]] const Sample& operator[](PointIndex i) const {
        heights.need(i);
        return samples[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] Sample& operator[](PointIndex i) {
        heights.need(i);
        return samples[static_cast<std::size_t>(i)];
    }
    /// A sample with motion and zone; normals and heights may be missing.
    [[nodiscard]] const Sample& without_heights(PointIndex i) const {
        zones.need(i);
        return samples[static_cast<std::size_t>(i)];
    }
    /// A sample with motion only.
    [[nodiscard]] const Sample& motion_of(PointIndex i) const {
        motion.need(i);
        return samples[static_cast<std::size_t>(i)];
    }
    /// Forgets all signals that are derived when they are read, and frees their memory.
    void forget();
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> feed(PointIndex i) const { return vector_of((*this)[i].feed); }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> acceleration(PointIndex i) const {
        return vector_of((*this)[i].acceleration);
    }
    [[nodiscard]] Eigen::Map<const Eigen::Vector3f> normal(PointIndex i) const { return vector_of((*this)[i].normal); }
};

/// The facts about a whole log that its signals depend on.
struct SignalFacts {
    double usual_speed = 0;          ///< [mm/s] 95th percentile of the points; 0: none moves
    float path_quantum = 0;          ///< [mm] finest step of the axes of the path …
    float quantum = 0;               ///< … the coarser one of path and measured positions; 0: none seen
    double scatter = 0;              ///< [mm] position_noise()
    std::vector<std::string> unfit;  ///< as in Signals
};

/// The length [mm] at the ends of passes that is not judged by default, because the tool does the same there on every pass. On
/// passes shorter than ten times this it is a tenth of the pass, but at least two step-overs and half the window of the
/// acceleration.
[[nodiscard]] double usual_end_zone(double step_over);

/// `path`: the trajectory that `surface` was gathered from. `measured`: the feedback or actual positions, or nullptr. `pieces`
/// (surface/smoothing_segments.h) bound the windows. `end_zone` [mm] at the ends of pieces is outside. O(points), parallel.
///
/// The lag is taken where the measured path crosses the plane through the commanded point normal to the feed. A lag *along* the
/// path, which has no effect on the surface, is thereby excluded.
///
/// `estimate`: speeds and accelerations are those of a Kalman smoother; nullptr: of least squares over windows.
[[nodiscard]] Signals derive_signals(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                                     const std::vector<PointRange>& pieces, double end_zone,
                                     const MotionEstimate* estimate = nullptr);

/// The facts that derive_signals() uses. O(points), parallel.
[[nodiscard]] SignalFacts measure_facts(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                                        const std::vector<PointRange>& pieces);

/// The same signals by least squares over windows, but each block is derived when one of its samples is first read. `surface`
/// must outlive them and must not move. O(pieces).
[[nodiscard]] Signals derive_when_read(const ClSurface& surface, const Trajectory& path, const Trajectory* measured,
                                       const std::vector<PointRange>& pieces, double end_zone,
                                       const SignalFacts& facts);

}  // namespace clsurf

#pragma once
// Signals: what is compared between neighbouring passes, once for every logged point: speed, feed
// direction, acceleration, and two heights along the surface normal. Everything is smoothed over a
// stated window inside one piece of the way, never across a link.

#include <string>
#include <vector>

#include "path/derivative.h"
#include "path/trajectory.h"
#include "surface/cl_surface.h"

namespace clsurf {

/// Three columns that are one vector per point.
struct Vectors {
    Column<float> x, y, z;

    void resize(std::size_t size) {
        x.resize(size);
        y.resize(size);
        z.resize(size);
    }
    [[nodiscard]] Eigen::Vector3f operator[](PointIndex i) const {
        const auto at = static_cast<std::size_t>(i);
        return {x[at], y[at], z[at]};
    }
    void set(PointIndex i, const Eigen::Vector3f& v) {
        const auto at = static_cast<std::size_t>(i);
        x[at] = v.x();
        y[at] = v.y();
        z[at] = v.z();
    }
};

/// Where on a pass a point lies.
enum class Zone : std::uint8_t {
    outside,  ///< not on a cut pass, or next to where a pass begins or ends: not compared
    ramp,     ///< the tool still speeds up from the pass's beginning, or slows down to its end
    inner,
};

struct Signals {
    Column<float> speed;   ///< [mm/s] of the surface's own positions
    Vectors feed;          ///< unit vector; NaN where the tool stands
    Vectors acceleration;  ///< [mm/s²]
    Vectors normal;        ///< unit vector of the CL surface, feed × (left − right); NaN: no neighbour
    Column<float> lag;     ///< [mm] how far the measured path runs above (+) the commanded one, along the normal; NaN: none
    Column<float> relief;  ///< [mm] how far the point lies above the chord between its neighbours, along the normal
    Column<Zone> zone;     ///< what a point can be compared with
    bool measured = false;       ///< there is a lag
    float quantum = 0;           ///< [mm] coarsest step in which the positions come; 0: none seen
    std::string speed_note, acceleration_note, height_note;  ///< the windows, "speed over 11 points (11 ms)"
};

/// `path` is what `surface` was gathered from; `measured` the feedback or actual positions, or nullptr.
/// `pieces` (path/pieces.h) bound the windows. `end_zone` [mm] at the ends of pieces is outside.
/// O(points), parallel.
///
/// The lag is where the measured path crosses the plane through the commanded point normal to the
/// feed: a lag *along* the path, which says nothing about the surface, drops out.
[[nodiscard]] Signals derive_signals(const ClSurface& surface, const Trajectory& path,
                                     const Trajectory* measured, const std::vector<PointRange>& pieces,
                                     double end_zone);

}  // namespace clsurf

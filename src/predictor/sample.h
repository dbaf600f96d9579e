#pragma once
// Sample: the compared quantities of one logged point (signals.h).

#include <cstdint>

#include "core/geometry.h"

namespace clsurf {

/// Zone of a pass that a point is in.
enum class Zone : std::uint8_t {
    outside,   ///< not on a cut pass, or next to the beginning or end of a pass: not compared
    ramp,      ///< the tool still speeds up from the beginning of the pass, or slows down to its end
    near_end,  ///< within the usual distance of a ramp from an end, but not in a ramp
    inner,     ///< the pass goes on
};

/// All signals of a point in one structure: comparing passes reads all of them at once, on a dozen passes at a time, and each
/// cache line costs time.
struct Sample {
    float speed;  ///< [mm/s] of the surface's own positions
    /// [mm] height of the measured path above (+) the commanded one, along the normal; NaN: none
    float normal_deviation;
    float relief;           ///< [mm] height of the point above the chord between its neighbours, along the normal
    float acceleration[3];  ///< [mm/s²]
    float feed[3];          ///< unit vector; NaN if the tool rests
    float normal[3];        ///< unit vector of the CL surface, feed × (left − right); NaN: no neighbour
    Zone zone;
};

[[nodiscard]] inline Eigen::Map<const Eigen::Vector3f> vector_of(const float (&v)[3]) {
    return Eigen::Map<const Eigen::Vector3f>(v);
}

}  // namespace clsurf

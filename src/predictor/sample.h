#pragma once
// Sample: what is compared of one logged point (signals.h).

#include <cstdint>

#include "core/geometry.h"

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

}  // namespace clsurf

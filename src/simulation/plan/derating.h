#pragma once
// Derating: a lower speed on a span, which leaves a part of the tangential limits to ramps on its bend.

#include "machine/machine.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

struct Derating {
    double cap = 0;                     ///< [mm/s]
    double acceleration = 0, jerk = 0;  ///< tangential limits that remain [mm/s², mm/s³]
};

/// Number of deratings. The first leaves most to ramps.
inline constexpr std::size_t deratings = 3;

/// The greatest speed at which derating `which` leaves its share to ramps.
[[nodiscard]] Derating derate(const Span& span, const Machine& machine, std::size_t which);

}  // namespace clsurf

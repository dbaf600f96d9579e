#pragma once
// Derating: a lower speed on a span, which leaves part of the tangential limits to ramps through its bend.

#include "machine/machine.h"
#include "simulation/path/path_stream.h"

namespace clsurf {

struct Derating {
    double cap = 0;                     ///< [mm/s]
    double acceleration = 0, jerk = 0;  ///< tangential, that it leaves [mm/s², mm/s³]
};

/// Ways of derating, from that which leaves most to ramps.
inline constexpr std::size_t deratings = 3;

/// The greatest speed that leaves what derating `which` asks for.
[[nodiscard]] Derating derate(const Span& span, const Machine& machine, std::size_t which);

}  // namespace clsurf

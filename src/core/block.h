#pragma once
// Everything per point is a loop over blocks of this many points: small enough for the L2 cache
// with a dozen columns of doubles, large enough that a block's overhead does not show.

#include <algorithm>
#include <cstdint>

#include "core/parallel.h"
#include "core/point.h"

namespace clsurf {

inline constexpr PointIndex block_points = 16384;

/// body(first, last) for every block of [0, count), `last` exclusive; in parallel.
template <typename Body>
void for_each_block(PointIndex count, Body&& body) {
    parallel_for(count, block_points, [&](std::int64_t first, std::int64_t last) { body(first, last); });
}

}  // namespace clsurf

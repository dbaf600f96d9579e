#pragma once
// Per-point work runs in loops over blocks of this many points. A block of a dozen columns of doubles fits the L2
// cache, and the overhead per block is negligible.

#include <algorithm>
#include <cstdint>

#include "core/parallel.h"
#include "core/point.h"

namespace clsurf {

inline constexpr PointIndex block_points = 16384;

/// Calls body(first, last) for every block of [0, count), `last` exclusive; in parallel.
template <typename Body>
void for_each_block(PointIndex count, Body&& body) {
    parallel_for(count, block_points, [&](std::int64_t first, std::int64_t last) { body(first, last); });
}

/// Calls body(first, last) for the part of every block that is inside `points`, `last` exclusive; in parallel.
template <typename Body>
void for_each_block(const PointRange& points, Body&& body) {
    const PointIndex begin = points.first / block_points;
    parallel_for(points.size() > 0 ? points.last / block_points - begin + 1 : 0, 1,
                 [&](std::int64_t from, std::int64_t to) {
                     for (PointIndex block = begin + from; block < begin + to; ++block) {
                         const PointIndex first = block * block_points;
                         body(std::max(points.first, first), std::min(points.last + 1, first + block_points));
                     }
                 });
}

}  // namespace clsurf

#pragma once
// Points are looked at in portions that lie in few blocks, between which blocks that were filled may be forgotten
// (core/block_fill.h). So what takes memory does not grow with the points that are looked at.

#include <algorithm>
#include <cstddef>
#include <unordered_set>

#include "core/block.h"
#include "core/block_fill.h"
#include "core/parallel.h"

namespace clsurf {

/// f(first, end) for portions of [0, count), one after the other; point_of(k) is the point that k looks at and about. Without
/// `forget` one portion is all.
template <typename PointOf, typename F>
void for_each_portion(std::size_t count, const ForgetBlocks& forget, PointOf&& point_of, F&& f) {
    if (!forget) {
        f(std::size_t{0}, count);
        return;
    }
    constexpr std::size_t blocks_at_once = 64;
    std::unordered_set<PointIndex> blocks;
    std::size_t first = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const PointIndex block = point_of(k) / block_points;
        if (!blocks.insert(block).second || blocks.size() <= blocks_at_once) continue;
        f(first, k);
        forget();
        first = k;
        blocks = {block};
    }
    f(first, count);
    forget();
}

/// f(k) for [0, count) in parallel, each of which looks at a region of its own: with `forget` as many at once as there are threads.
template <typename F>
void for_each_at_once(std::size_t count, const ForgetBlocks& forget, F&& f) {
    const std::size_t at_once = forget ? static_cast<std::size_t>(thread_count()) : count;
    for (std::size_t begin = 0; begin < count; begin += at_once) {
        const std::size_t end = std::min(count, begin + at_once);
        parallel_for(static_cast<std::int64_t>(end - begin), 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) f(begin + static_cast<std::size_t>(k));
        });
        if (forget) forget();
    }
}

/// f(k) for [0, count), in parallel unless f itself forgets, which nobody else may be reading.
template <typename F>
void for_each_alone_or_at_once(std::size_t count, const ForgetBlocks& forget, F&& f) {
    parallel_for(static_cast<std::int64_t>(count), forget ? static_cast<std::int64_t>(count) : 1,
                 [&](std::int64_t first, std::int64_t last) {
                     for (std::int64_t k = first; k < last; ++k) f(static_cast<std::size_t>(k));
                 });
}

}  // namespace clsurf

#pragma once
// Points are processed in portions that touch few blocks. Between portions, filled blocks may be freed
// (core/block_fill.h), so the memory does not grow with the number of points.

#include <algorithm>
#include <cstddef>
#include <unordered_set>

#include "core/block.h"
#include "core/block_fill.h"
#include "core/parallel.h"

namespace clsurf {

/// Calls f(first, end) for portions of [0, count), one after the other; item k reads the points around point_of(k).
/// Without `forget` there is a single portion.
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

/// Calls f(k) for [0, count) in parallel; each k reads its own region. With `forget`, as many run at once as there are
/// threads.
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

/// Calls f(k) for [0, count), in parallel unless f itself frees blocks; then no other thread may be reading.
template <typename F>
void for_each_alone_or_at_once(std::size_t count, const ForgetBlocks& forget, F&& f) {
    parallel_for(static_cast<std::int64_t>(count), forget ? static_cast<std::int64_t>(count) : 1,
                 [&](std::int64_t first, std::int64_t last) {
                     for (std::int64_t k = first; k < last; ++k) f(static_cast<std::size_t>(k));
                 });
}

}  // namespace clsurf

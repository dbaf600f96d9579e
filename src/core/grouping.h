#pragma once
// Grouping: numbers sorted by group.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace clsurf {

/// 0 … count − 1 sorted by group, ascending inside each.
struct Grouping {
    std::vector<std::size_t> start;  ///< index in `order` of the start of each group, and of the end of the last
    std::vector<std::uint32_t> order;

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t group) const {
        return std::span(order).subspan(start[group], start[group + 1] - start[group]);
    }
};

/// `group_of(k)` < groups, called twice for each k. Counting sort: O(count + groups).
template <typename GroupOf>
[[nodiscard]] Grouping group_numbers(std::size_t count, std::size_t groups, const GroupOf& group_of) {
    Grouping result;
    result.start.assign(groups + 1, 0);
    for (std::size_t k = 0; k < count; ++k) ++result.start[group_of(k) + 1];
    for (std::size_t g = 1; g <= groups; ++g) result.start[g] += result.start[g - 1];
    result.order.resize(count);
    std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
    for (std::size_t k = 0; k < count; ++k) result.order[next[group_of(k)]++] = static_cast<std::uint32_t>(k);
    return result;
}

}  // namespace clsurf

#pragma once
// The median of a quantity over a few passes, some of which may have no value.

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace clsurf {

/// The median of at most ten values. A NaN is left out; for an even number it is the mean of the middle two. NaN if fewer
/// than `fewest` remain.
template <typename T, typename Read>
[[nodiscard]] float median_of(std::span<const T> places, std::size_t fewest, Read&& read) {
    std::array<float, 10> values;
    std::size_t count = 0;
    for (const T& place : places) {
        const float value = read(place);
        if (!(value == value)) continue;
        std::size_t k = count++;
        for (; k > 0 && values[k - 1] > value; --k) values[k] = values[k - 1];
        values[k] = value;
    }
    if (count < fewest) return std::numeric_limits<float>::quiet_NaN();
    const std::size_t middle = count / 2;
    return count % 2 == 1 ? values[middle] : 0.5F * (values[middle - 1] + values[middle]);
}

}  // namespace clsurf

#pragma once
// Order statistics of values in any order. The functions reorder their input: O(values), no copy. Domain: at least
// one value, no NaN.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace clsurf {

/// The k-th smallest value, from 0.
template <typename Values>
[[nodiscard]] auto kth_smallest(Values& values, std::size_t k) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The middle value; of an even number of values, the upper of the two.
template <typename Values>
[[nodiscard]] auto median(Values& values) {
    return kth_smallest(values, std::size(values) / 2);
}

/// The median as in NumPy: of an even number of values, the mean of the two in the middle.
template <typename Values>
[[nodiscard]] auto midpoint_median(Values&& values) {
    const std::size_t half = std::size(values) / 2;
    const auto upper = kth_smallest(values, half);
    return std::size(values) % 2 == 1 ? upper : (upper + kth_smallest(values, half - 1)) / 2;
}

/// The quantile for a share (0 … 1); if it is between two values, the lower one.
template <typename Values>
[[nodiscard]] auto quantile_below(Values& values, double share) {
    return kth_smallest(values, static_cast<std::size_t>(share * static_cast<double>(std::size(values) - 1)));
}

/// The same; if it is between two values, the nearer one.
template <typename Values>
[[nodiscard]] auto nearest_quantile(Values& values, double share) {
    return kth_smallest(values,
                        static_cast<std::size_t>(std::lround(share * static_cast<double>(std::size(values) - 1))));
}

/// Weighted quantile: the least value up to which the weights sum to a share (0 … 1) of all. `values`: pairs of a value and
/// its weight, in any order; sorted afterwards. Domain: not empty. O(n log n).
template <typename Values>
[[nodiscard]] double weighted_quantile(Values& values, double share) {
    std::sort(values.begin(), values.end());
    double all = 0;
    for (const auto& [value, weight] : values) all += weight;
    double sum = 0;
    for (const auto& [value, weight] : values) {
        sum += weight;
        if (sum >= share * all) return value;
    }
    return values.back().first;
}

/// Standard deviation over median absolute deviation of a normal distribution.
inline constexpr double deviation_of_mad = 1.4826;

/// The median of some values, and how far they scatter about it.
struct Spread {
    double median = 0, deviation = 0;  ///< deviation: from the median absolute one, so that some outliers do not matter
};
/// Reorders the values.
template <typename Values>
[[nodiscard]] Spread robust_spread(Values& values) {
    const double middle = median(values);
    for (auto& value : values) value = std::abs(value - middle);
    return {middle, deviation_of_mad * median(values)};
}

}  // namespace clsurf

#pragma once
// Rule for jumps of a logged position that no axis can make: a counter overflows, or a record is wrong. The step is longer
// than any acceleration allows and much longer than the step before it. It is also much longer than the step after it, unless
// that step goes back (a spike).

#include <algorithm>

namespace clsurf {

/// [mm/s² or deg/s²] 10 g: more than any feed axis reaches.
inline constexpr double impossible_acceleration = 1e5;

/// Only a longer step is a jump [mm or deg]. `period` [s].
[[nodiscard]] inline double longest_step(double period) {
    constexpr double least_jump = 0.05;
    return std::max(least_jump, impossible_acceleration * period * period);
}

/// Whether the next step goes back, by their scalar product (for one axis: the product) and their lengths.
[[nodiscard]] inline bool comes_back(double product, double length, double next_length) {
    return product < -0.5 * length * next_length;
}

/// Whether a step longer than longest_step() is a jump compared with the steps before and after it.
[[nodiscard]] inline bool is_jump(double length_before, double length, double next_length, bool next_comes_back) {
    constexpr double factor = 3;
    return length > factor * length_before && (next_comes_back || length > factor * next_length);
}

}  // namespace clsurf

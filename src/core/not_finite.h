#pragma once
// Names of values that are not finite numbers.

#include <limits>

namespace clsurf {

/// The value of a column or a result without a value: NaN, whose comparisons are all false.
template <typename Real>
inline constexpr Real missing = std::numeric_limits<Real>::quiet_NaN();

/// A bound without effect.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace clsurf

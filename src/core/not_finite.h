#pragma once
// Names of values that are not finite numbers.

#include <limits>

namespace clsurf {

/// What a column or a result holds where there is no value: NaN, whose comparisons are all false.
template <typename Real>
inline constexpr Real missing = std::numeric_limits<Real>::quiet_NaN();

/// A bound that holds nothing back.
inline constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace clsurf

#pragma once
// AsMachinedProfile: a section through the as-machined surface, with its roughness.

#include <cstddef>
#include <vector>

#include "machined/as_machined_surface.h"
#include "machined/roughness.h"

namespace clsurf {

/// A profile of the as-machined surface.
struct AsMachinedProfile {
    double step = 0;                   ///< [mm] between values, seen from above
    std::vector<double> deviation;     ///< [mm] from the form; NaN: nothing was cut, or there is no form
    std::vector<double> along;         ///< [mm] arc length of the form at each value, for filter and sampling lengths
    std::size_t first = 0, count = 0;  ///< the longest section without gaps …
    Roughness roughness;               ///< … and its roughness
};

/// A profile from one place to another [mm], both included, with a value at least every 1/200 of a step-over.
[[nodiscard]] AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& to);
/// The same with the form of another surface of the part.
[[nodiscard]] AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                                const Vec2& from, const Vec2& to);

}  // namespace clsurf

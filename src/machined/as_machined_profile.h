#pragma once
// AsMachinedProfile: a section through the as-machined surface, with its roughness.

#include <cstddef>
#include <vector>

#include "machined/as_machined_surface.h"
#include "machined/roughness.h"

namespace clsurf {

/// A profile across the formed surface.
struct AsMachinedProfile {
    double step = 0;                ///< [mm] between values, seen from above
    std::vector<double> deviation;  ///< [mm] over the form; NaN: nothing was cut, or no form there
    std::vector<double> along;      ///< [mm] arc length of the form at each value: of its filter and sampling lengths
    std::size_t first = 0, count = 0;  ///< the longest section without gaps …
    Roughness roughness;               ///< … and its roughness
};

/// From one place to another [mm], both ends included, a value at least every 1/200 of a step-over.
[[nodiscard]] AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const Vec2& from, const Vec2& to);
/// The same over the form of another surface of the part.
[[nodiscard]] AsMachinedProfile measure_profile(const AsMachinedSurface& as_machined, const AsMachinedSurface& form_of,
                                                const Vec2& from, const Vec2& to);

}  // namespace clsurf

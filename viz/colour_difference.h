#pragma once
// Perceived difference of two colours: CIE L*a*b* and ΔE00.

#include <array>

#include "viz/colour_map.h"

namespace clsurf::viz {

/// L*, a*, b*, white point D65.
using Lab = std::array<double, 3>;

/// sRGB, each 0 … 1, to L*a*b* (IEC 61966-2-1, CIE 15).
[[nodiscard]] Lab lab_of(const std::array<double, 3>& rgb);
[[nodiscard]] Lab lab_of(const Rgb& rgb);

/// CIEDE2000 (ISO/CIE 11664-6) with kL = kC = kH = 1. A difference of about 1 is just visible side by side.
[[nodiscard]] double delta_e00(const Lab& first, const Lab& second);

}  // namespace clsurf::viz

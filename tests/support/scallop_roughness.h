#pragma once
// The roughness of scallops of a known height in closed form (ISO 4287 names), for comparison with measured roughness.

#include <cmath>

namespace clsurf::test {

/// Ra of a periodic profile of parabolas of height h: 4 h / (9 √3). Same unit as h.
inline double scallop_ra(double height) { return 4 * height / (9 * std::sqrt(3.0)); }

/// Rq of the same profile: h √(4/45).
inline double scallop_rq(double height) { return height * std::sqrt(4.0 / 45.0); }

}  // namespace clsurf::test

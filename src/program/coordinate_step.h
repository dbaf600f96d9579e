#pragma once
// The step to which the coordinates of a program are rounded.

#include "program/motion.h"

namespace clsurf {

/// The smallest step of the three axes [mm]: per axis, the largest of 0.1, 0.01 … 0.000001 mm, or of an inch, that divides
/// nine tenths of its coordinates; 0 if there are more digits, or no coordinates. The coordinates are the ends of cutting
/// motions as programmed, before frames rotate and shift them. O(10⁴): longer programs are sampled.
[[nodiscard]] double coordinate_step(const Motions& motions);

}  // namespace clsurf

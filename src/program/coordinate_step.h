#pragma once
// The step to which the coordinates of a program are rounded.

#include "program/motion.h"

namespace clsurf {

/// The largest of 0.1, 0.01 … 0.000001 mm, or of an inch, of which nine tenths of an axis' coordinates are multiples, and of
/// the three axes the smallest [mm]; 0: there are more digits, or no coordinates. Ends of cutting motions count, in the
/// coordinates of the words, before frames turn and shift them. O(10⁴): of longer programs a sample.
[[nodiscard]] double coordinate_step(const Motions& motions);

}  // namespace clsurf

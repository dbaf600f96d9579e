#pragma once
// Ramps of passes: where the tool speeds up after a pass begins, and slows down before it ends.

#include <vector>

#include "field/field.h"
#include "surface/passes.h"

namespace clsurf {

/// The ramps of all cut passes, and the links between passes, in the order of their points: from an end inwards as long as the speed rises by 2 % in every
/// 5 ms. Before that it may fall for 50 ms, as where the step to the next pass belongs to the pass. What gains less than a
/// tenth is no ramp. `speed`: path speeds, or shares of the feed; `period` of the log [s]. O(passes + points of ramps).
[[nodiscard]] std::vector<PointRange> pass_ramps(const Field& speed, const Passes& passes, double period);

}  // namespace clsurf

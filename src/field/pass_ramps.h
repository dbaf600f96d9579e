#pragma once
// Ramps of passes: sections of acceleration at the beginning of a pass and of braking at its end.

#include <vector>

#include "field/field.h"
#include "surface/passes.h"

namespace clsurf {

/// The ramps of all cut passes, and the links between passes, in the order of their points. A ramp extends inwards from an
/// end as long as the speed rises by 2 % in every 5 ms. Before that the speed may fall for 50 ms, for example if the move to
/// the next pass belongs to the pass. A gain of less than a tenth is not a ramp. `speed`: path speeds, or shares of the feed;
/// `period` of the log [s]. O(passes + points of ramps).
[[nodiscard]] std::vector<PointRange> pass_ramps(const Field& speed, const Passes& passes, double period);

}  // namespace clsurf

#pragma once
// How accurately an identification knows the values that plan the motion.

#include <vector>

#include "identify/identification.h"

namespace clsurf {

/// Standard errors, lower bounds and values that the runs did not distinguish, for the values that is_planning_value()
/// names. Rules with words as values have no row.
[[nodiscard]] std::vector<ParameterUncertainty> uncertainty_of(const Identification& result);

}  // namespace clsurf

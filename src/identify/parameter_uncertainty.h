#pragma once
// How well an identification knows the values that plan the motion.

#include <vector>

#include "identify/identification.h"

namespace clsurf {

/// Standard errors, lower bounds and values that the runs did not tell apart, of the values that is_planning_value()
/// names. Rules whose values are words have no row.
[[nodiscard]] std::vector<ParameterUncertainty> uncertainty_of(const Identification& result);

}  // namespace clsurf

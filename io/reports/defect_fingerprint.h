#pragma once
// A name of a defect that stays the same from run to run of a program: what SARIF compares results by, and what a file
// of accepted defects names them by.

#include <string>
#include <vector>

#include "predictor/defect.h"

namespace clsurf::io {

/// One for each defect, all different: what, on which pass, and about where, in cells of 5 mm; of those that have the
/// same, the second one ends in "/2".
[[nodiscard]] std::vector<std::string> fingerprints_of(const std::vector<Defect>& defects);

}  // namespace clsurf::io

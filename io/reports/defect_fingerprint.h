#pragma once
// An identifier of a defect that stays the same from run to run of a program. SARIF compares results by it, and files
// of accepted defects refer to it.

#include <string>
#include <vector>

#include "predictor/defect.h"

namespace clsurf::io {

/// One for each defect, all different: its kind, its pass, and its position in cells of 5 mm. If several are
/// equal, the second one ends in "/2".
[[nodiscard]] std::vector<std::string> fingerprints_of(const std::vector<Defect>& defects);

}  // namespace clsurf::io

#pragma once
// Defects in JSON: the same keys in every report.

#include <vector>

#include "io/files/json_value.h"
#include "predictor/defects.h"

namespace clsurf::io {

/// A list; keys: docs/predictor.md. `scallop` [mm] of the tool, 0: not known.
[[nodiscard]] Json list_defects(const std::vector<Defect>& defects, double scallop);

}  // namespace clsurf::io

#pragma once
// A defect in JSON: the same keys in every report that lists some.

#include <cstddef>

#include "io/json_value.h"
#include "quality/defects.h"

namespace clsurf::io {

/// Keys: docs/predictor.md. `id` from 1; `scallop` [mm] of the tool, 0: none is known.
[[nodiscard]] Json defect_json(const Defect& defect, std::size_t id, double scallop);

}  // namespace clsurf::io

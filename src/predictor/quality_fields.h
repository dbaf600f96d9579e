#pragma once
// The fields of the predictor: differences of a point to the adjacent passes, as colours and curves.

#include <span>
#include <string_view>

#include "field/field.h"
#include "predictor/mismatch.h"

namespace clsurf {

/// speed_mismatch, acceleration_mismatch, height.
[[nodiscard]] std::span<const FieldInfo> quality_fields();
[[nodiscard]] bool is_quality_field(std::string_view name);

/// One value per point, NaN where there is no neighbour on either side; `name` is one of the above.
/// The note says the windows and how many of the cutting points have a value. O(points), parallel.
[[nodiscard]] Field quality_field(std::string_view name, const ClSurface& surface, const Signals& signals);

}  // namespace clsurf

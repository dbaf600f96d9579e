#pragma once
// The fields of a part, in one registry: positions, the comparison with adjacent passes, intervals, channels.

#include <memory>
#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"

namespace clsurf {

/// All fields of a part that can be coloured, plotted and exported. `more`: other providers, whose fields come before the
/// log's channels. Part and surface must outlive the result. O(points) with derivatives of a Kalman smoother.
[[nodiscard]] FieldSet fields_of(const Part& part, const ClSurface& surface,
                                 const std::vector<std::shared_ptr<const FieldProvider>>& more = {});

/// The fields that depend only on a point and its vicinity on the path, not on adjacent passes or the whole run. Part and
/// surface must outlive the result.
[[nodiscard]] FieldSet path_fields_of(const Part& part, const ClSurface& surface);

}  // namespace clsurf

#pragma once
// The fields of a part, in one registry: positions, the comparison with adjacent passes, intervals, channels.

#include <memory>
#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"

namespace clsurf {

/// All that can be coloured, plotted and exported of a part. `more`: other providers, whose fields come before the log's
/// channels. Part and surface must outlive it. O(points) where the part's derivatives are those of a Kalman smoother.
[[nodiscard]] FieldSet fields_of(const Part& part, const ClSurface& surface,
                                 const std::vector<std::shared_ptr<const FieldProvider>>& more = {});

}  // namespace clsurf

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

/// Those that depend only on a point and on what lies close to it on the path: not on adjacent passes, nor on the run as a
/// whole. Part and surface must outlive it.
[[nodiscard]] FieldSet path_fields_of(const Part& part, const ClSurface& surface);

}  // namespace clsurf

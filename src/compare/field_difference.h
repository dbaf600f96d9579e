#pragma once
// Field difference: difference of a field between two runs of a part, place by place, for a picture next to the pictures of
// both runs.

#include "compare/run_alignment.h"
#include "field/field.h"

namespace clsurf {

/// `after` minus `before` at the points of `after`. `alignment` gives their locations on the run before; NaN if there is none.
/// Domain: both are the same field, of numbers. O(points), parallel.
[[nodiscard]] Field difference_of(const Field& after, const Field& before, const RunAlignment& alignment);

}  // namespace clsurf

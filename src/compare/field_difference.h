#pragma once
// Field difference: a field of two runs of a part, place by place: what a picture of before and after shows beside both.

#include "compare/run_alignment.h"
#include "field/field.h"

namespace clsurf {

/// `after` minus `before` at the points of `after`, whose places on the run before `alignment` has; NaN where there is none.
/// Domain: both are the same field, of numbers. O(points), parallel.
[[nodiscard]] Field difference_of(const Field& after, const Field& before, const RunAlignment& alignment);

}  // namespace clsurf

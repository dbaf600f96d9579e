#pragma once
// Patches: connected points with values beyond an end of a range.

#include <functional>

#include "field/field.h"
#include "surface/adjacency.h"

namespace clsurf {

/// The points that the picture shows; empty: all.
using ShownPoints = std::function<bool(PointIndex)>;

/// The least end ≥ `end` (for `above`; else the greatest ≤ `end`) that no patch of `size` cutting points exceeds, in
/// internal units. Consecutive points of the path are connected, and with `neighbours` also neighbours on adjacent passes.
/// O(points + beyond log beyond) for the points beyond, which are assumed to be few.
[[nodiscard]] float end_without_patches(const Field& field, const Passes& passes, const Adjacency* neighbours,
                                        const ShownPoints& shown, float end, bool above, std::size_t size);

/// The least end ≥ `end` (the greatest ≤ `end`) that includes whole sections: at least `size` connected cutting points that
/// exceed `threshold` (for `above`; else that are below −threshold). Smaller groups, for example the spike of one point, do
/// not count. Internal units, threshold > 0. O(points).
[[nodiscard]] float end_with_sections(const Field& field, const Passes& passes, const Adjacency* neighbours,
                                      const ShownPoints& shown, float end, bool above, float threshold,
                                      std::size_t size);

}  // namespace clsurf

#pragma once
// Patches: connected points whose values lie beyond an end of a range.

#include <functional>

#include "field/field.h"
#include "surface/adjacency.h"

namespace clsurf {

/// Which points the picture shows; empty: all.
using ShownPoints = std::function<bool(PointIndex)>;

/// Points in the order of the path are connected, and so are neighbours on adjacent passes where `neighbours` is given.
/// The least end ≥ `end` (for `above`; else the greatest ≤ `end`) that no patch of `size` cutting points exceeds, in inside
/// units. O(points + beyond log beyond), where few points are beyond.
[[nodiscard]] float end_without_patches(const Field& field, const Passes& passes, const Adjacency* neighbours,
                                        const ShownPoints& shown, float end, bool above, std::size_t size);

/// The least end ≥ `end` (the greatest ≤ `end`) that holds whole sections: at least `size` connected cutting points that exceed
/// `threshold` (for `above`; else that lie below −threshold). What fewer points exceed it, such as the spike of one, does
/// not count. Inside units, threshold > 0. O(points).
[[nodiscard]] float end_with_sections(const Field& field, const Passes& passes, const Adjacency* neighbours,
                                      const ShownPoints& shown, float end, bool above, float threshold,
                                      std::size_t size);

}  // namespace clsurf

#pragma once
// Assigns names next to a part to marks: slots in a column, so that the leaders can be distinguished.

#include <cstddef>
#include <vector>

#include "core/geometry.h"

namespace clsurf::viz {

/// The slot of the name of each anchor, so that no two leaders cross and, if possible, none is closer than
/// `clearance` [px] to the anchor of another one. `anchors` [px], `slots`: heights [px] at `slot_x`, as many as anchors; all
/// anchors are on one side of slot_x. At most O(n⁴) steps for n anchors in practice.
[[nodiscard]] std::vector<std::size_t> assign_slots(const std::vector<Vec2>& anchors, const std::vector<double>& slots,
                                                    double slot_x, double clearance);

/// A column of names, and the slot of each anchor.
struct NameColumn {
    double top = 0;                    ///< [px]
    std::vector<double> slots;         ///< heights of their middles, from the top [px]
    std::vector<std::size_t> slot_of;  ///< by anchor
};

/// A column of slots of height `slot` [px] near its anchors, between `lowest` and `highest` [px]. It is moved a little up
/// or down if leaders then keep clear of other anchors. Domain: the column fits.
[[nodiscard]] NameColumn place_names(const std::vector<Vec2>& anchors, double slot, double lowest, double highest,
                                     double slot_x, double clearance);

/// The beginning of a column of `height` [px] near its anchors, between `lowest` and `highest` [px]. Domain:
/// the column fits.
[[nodiscard]] double top_of_names(const std::vector<Vec2>& anchors, double height, double lowest, double highest);

}  // namespace clsurf::viz

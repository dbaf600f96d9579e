#pragma once
// Which name beside a part belongs to which mark: slots in a column, so that the leaders can be told apart.

#include <cstddef>
#include <vector>

#include "core/geometry.h"

namespace clsurf::viz {

/// For each anchor the slot of its name, so that no two leaders cross and, as far as that is possible, none runs closer than
/// `clearance` [px] past the anchor of another one. `anchors` [px], `slots`: heights [px] at `slot_x`, as many as anchors, all
/// anchors on one side of slot_x. O(n⁴) steps at most for n anchors in practice.
[[nodiscard]] std::vector<std::size_t> assign_slots(const std::vector<Vec2>& anchors, const std::vector<double>& slots,
                                                    double slot_x, double clearance);

/// A column of names, and which slot of it each anchor has.
struct NameColumn {
    double top = 0;                    ///< [px]
    std::vector<double> slots;         ///< heights of their middles, from the top [px]
    std::vector<std::size_t> slot_of;  ///< by anchor
};

/// The column of slots of `slot` height [px] beside its anchors, in a room from `lowest` to `highest` [px]. It lies a little
/// higher or lower where leaders then keep clear of other anchors. Domain: the column fits.
[[nodiscard]] NameColumn place_names(const std::vector<Vec2>& anchors, double slot, double lowest, double highest,
                                     double slot_x, double clearance);

/// Where a column of `height` [px] begins so that it is beside its anchors, in a room from `lowest` to `highest` [px]. Domain:
/// the column fits.
[[nodiscard]] double top_of_names(const std::vector<Vec2>& anchors, double height, double lowest, double highest);

}  // namespace clsurf::viz

#pragma once
// Ramp: how a speed that is lowered at one place returns to its original value along a pass.

#include <cstdint>
#include <span>

#include "core/not_finite.h"
#include "machine/machine.h"

namespace clsurf {

/// Limits of the change of speed along a pass.
struct Ramp {
    double acceleration = infinite;  ///< [mm/s²]
    double jerk = infinite;          ///< [mm/s³]
};

/// The limits of a machine that apply in every direction: the smallest of its axes and of its path.
[[nodiscard]] Ramp ramp_of(const Machine& machine);

/// Lowers `speeds` [mm/s], one per period [s], around places that are already lowered, to what the ramp allows: from a low
/// place they rise no faster, and between two low places their peak is no sharper. Changes of `own`, the speeds of the machine,
/// are always allowed. Lowered points take over the cause (≥ 0; −1: none) of the place for which they are lowered. All spans
/// have one entry per point, without NaN. O(points).
void keep_to_ramp(const Ramp& ramp, double period, std::span<const float> own, std::span<float> speeds,
                  std::span<std::int32_t> causes);

}  // namespace clsurf

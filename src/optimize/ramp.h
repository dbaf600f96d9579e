#pragma once
// Ramp: how a speed that is lowered at a place comes back to its own along a pass.

#include <cstdint>
#include <span>

#include "core/not_finite.h"
#include "machine/machine.h"

namespace clsurf {

/// How fast a speed may change along a pass.
struct Ramp {
    double acceleration = infinite;  ///< [mm/s²]
    double jerk = infinite;          ///< [mm/s³]
};

/// What a machine can do in every direction: the least of its axes and of its path.
[[nodiscard]] Ramp ramp_of(const Machine& machine);

/// Lowers `speeds` [mm/s], one a period [s], about what is lowered already, to what the ramp allows: from a low place on they
/// grow no faster, and between two of them they turn round no sharper. Where they have the shape of `own`, the speeds that the
/// machine ran, they may change as those do. Lowered points take over the cause (≥ 0; −1: none) of the place that they are lowered for.
/// All spans have one entry a point, and no NaN. O(points).
void keep_to_ramp(const Ramp& ramp, double period, std::span<const float> own, std::span<float> speeds,
                  std::span<std::int32_t> causes);

}  // namespace clsurf

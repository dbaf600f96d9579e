#pragma once
// The step of recorded positions. Differences that rounding alone can explain must not be judged.

#include "core/channel_view.h"

namespace clsurf {

/// The step of a channel, in its unit: the smallest change of its differences, if nearly all are multiples of it; 0:
/// no grid. From 20,000 points in the middle of the channel.
[[nodiscard]] double quantum_of(const ChannelView& channel);

/// The rounding step of a channel, in its unit, from moving sections all over the log: that of quantum_of(), else the
/// coarsest power of ten of its stored numbers, else the last digit of its type. The rounding error is at most half of
/// it.
[[nodiscard]] double resolution_of(const ChannelView& channel);

}  // namespace clsurf

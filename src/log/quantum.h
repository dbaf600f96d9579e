#pragma once
// The step of recorded positions. Differences that rounding alone can explain must not be judged.

#include "core/channel_view.h"

namespace clsurf {

/// The step of a channel, in its unit: the smallest change of its differences, where nearly all are multiples of it;
/// 0: no grid. From 20,000 points in the middle of the channel.
[[nodiscard]] double quantum_of(const ChannelView& channel);

/// The step that rounding left in a channel, in its unit, from sections where it moves all over the log: quantum_of()'s,
/// else the coarsest power of ten of its stored numbers, else the last place of its type. Rounding is off by half of it.
[[nodiscard]] double resolution_of(const ChannelView& channel);

}  // namespace clsurf

#pragma once
// The step of recorded positions. Differences that rounding alone can explain must not be judged.

#include "core/channel_view.h"

namespace clsurf {

/// The step of a channel, in its unit: the smallest change of its differences, where nearly all are multiples of it;
/// 0: no grid. From 20,000 points in the middle of the channel.
[[nodiscard]] double quantum_of(const ChannelView& channel);

}  // namespace clsurf

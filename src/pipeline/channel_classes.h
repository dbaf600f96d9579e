#pragma once
// The meaning of the values of channels that contain classes.

#include <vector>

#include "field/channel_fields.h"

namespace clsurf {

/// `limit` of simulated logs, `motion` of LinuxCNC's, and `line`.
[[nodiscard]] std::vector<ChannelClasses> channel_classes();

}  // namespace clsurf

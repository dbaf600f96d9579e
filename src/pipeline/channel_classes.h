#pragma once
// What the values of channels mean whose values are names.

#include <vector>

#include "field/channel_fields.h"

namespace clsurf {

/// `limit` of simulated logs, `motion` of LinuxCNC's, and `line`.
[[nodiscard]] std::vector<ChannelClasses> channel_classes();

}  // namespace clsurf

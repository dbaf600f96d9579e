#pragma once
// The meaning of values of channels whose values are classes.

#include <vector>

#include "field/channel_fields.h"

namespace clsurf {

/// `limit` of simulated logs, `motion` of LinuxCNC's, and `line`.
[[nodiscard]] std::vector<ChannelClasses> channel_classes();

}  // namespace clsurf

#pragma once
// Feeds at which a program runs at the planned speeds of its constant-speed intervals.

#include <vector>

#include "machine/machine.h"
#include "program/program.h"

namespace clsurf {

/// The feed of each motion [mm/s], if it is below the programmed one; 0: the programmed feed remains. The machine's feed
/// override applies to these feeds. O(points log points).
[[nodiscard]] std::vector<float> interval_feeds(const Program& program, const Machine& machine);

/// Lowers the feeds of a program to these values, as a controller with `feed = "intervals"` does.
void hold_interval_speeds(Program& program, const Machine& machine);

}  // namespace clsurf

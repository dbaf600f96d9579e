#pragma once
// Limits of speed, acceleration and jerk, from the commanded motion of the runs.

#include <span>

#include "identify/identification.h"
#include "identify/identify_run.h"

namespace clsurf {

/// Finds the limits of every commanded axis and of the path. A limit is reached if the motion stays at it over consecutive
/// records in at least three places and hardly ever exceeds it, and if no other limit explains it. All other values are
/// lower bounds. On a path parallel to an axis, the limits of path and axis have the same effect: both are then lower
/// bounds, and the machine gets the limit of the path. Limits of speed are searched in rapids only: in other moves the
/// speed is the programmed feed. Differences are not smoothed; if positions are rounded, the differences cover as many
/// records as the rounding requires. O(records), at most 4·10^6 of them.
void identify_limits(std::span<const IdentifyRun> runs, Identification& result);

}  // namespace clsurf

#pragma once
// Limits of speed, acceleration and jerk, from the commanded motion of the runs.

#include <span>

#include "identify/identification.h"
#include "identify/identify_run.h"

namespace clsurf {

/// Finds the limits of every commanded axis and of the path. A limit is reached where the motion stays at it over
/// consecutive records in at least three places, hardly ever exceeds it, and no other limit explains it; all others are lower
/// bounds. On a path parallel to an axis, the limits of path and axis have the same effect: both are lower bounds then, and the
/// machine gets the limit of the path. Limits of speed are
/// looked for in rapids alone: elsewhere the programmed feed is held. Differences are not smoothed; where positions are
/// rounded they are taken over as many records as the rounding asks for. O(records), at most 4·10^6 of them.
void identify_limits(std::span<const IdentifyRun> runs, Identification& result);

}  // namespace clsurf

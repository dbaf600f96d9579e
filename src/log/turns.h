#pragma once
// Rotary axes that count within one turn (modulo axes): after 359.9° comes 0.1°, without a motion of a whole turn.

#include "log/log.h"

namespace clsurf {

/// Unwraps the positions of such axes [deg], in all roles alike, and adds a note `log.modulo` for each axis. An axis is a
/// modulo axis if all its values are within one turn and at least one step is a wrap: without the turn, it is as long as
/// the steps before and after it. Every step is then taken in the shorter direction. O(records), in parallel; only axes
/// that wrap get new columns.
void count_turns_on(Log& log);

}  // namespace clsurf

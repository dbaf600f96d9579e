#pragma once
// Rotary axes that count within one turn (modulo axes): from 359.9° they go on at 0.1°, and nothing has moved by a turn.

#include "log/log.h"

namespace clsurf {

/// Lets the positions of such axes count on beyond a turn, in all roles alike, with a note `log.modulo` for each axis. An
/// axis is one if all its values lie within a turn and some step is that of a wrap: less a turn it is as long as those
/// beside it. Then each step goes the shorter way. The log has its positions in degrees. O(records), parallel; new columns
/// only of axes that wrap.
void count_turns_on(Log& log);

}  // namespace clsurf

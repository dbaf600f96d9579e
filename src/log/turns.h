#pragma once
// Rotary axes that count within one turn (modulo axes): from 359.9° they go on at 0.1°, and nothing has moved by a turn.

#include "log/log.h"

namespace clsurf {

/// Makes the positions of such axes [deg] count on beyond a turn, in all roles alike, and adds a note `log.modulo` for each
/// axis. An axis is a modulo axis if all its values lie within one turn and at least one step is a wrap: without the turn,
/// it is as long as the steps before and after it. Every step is then taken the shorter way round. O(records), in parallel;
/// only axes that wrap get new columns.
void count_turns_on(Log& log);

}  // namespace clsurf

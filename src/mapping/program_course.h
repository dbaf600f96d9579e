#pragma once
// How a log goes through its program: from the start, once, without a stop, or otherwise.

#include "log/log.h"
#include "mapping/line_map.h"

namespace clsurf {

/// Notes what the numbers of a whole, single run would hide:
/// - map.begins-inside, map.ends-early: the log has a part of the program only (warnings)
/// - map.runs: the program begins again: two runs in one file
/// - map.pause: the tool stands still for more than a second on a line that cuts
/// Returns the share of the program's motions before and after the log, 0 … 1; 0 where it has all but an approach and
/// a retract. O(points).
double note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                   Diagnostics& diagnostics);

}  // namespace clsurf

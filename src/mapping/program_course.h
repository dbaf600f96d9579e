#pragma once
// How a log goes through its program: from the start, once, without a stop, or otherwise.

#include <span>

#include "log/log.h"
#include "mapping/line_map.h"
#include "mapping/program_runs.h"

namespace clsurf {

/// Notes what the numbers of a whole, single run would hide:
/// - map.begins-inside, map.ends-early: the log has a part of the program only (warnings)
/// - map.runs: the program begins again: two runs in one file (a warning)
/// - map.restart: a run goes on from an earlier line: what lies between ran twice (a warning)
/// - map.pause: the tool stands still for more than a second on a line that cuts
/// Returns the share of the program's motions before and after the log, 0 … 1; 0 where it has all but an approach and
/// a retract. `runs`: as find_program_runs() has them. O(points).
double note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                   std::span<const ProgramRun> runs, Diagnostics& diagnostics);

}  // namespace clsurf

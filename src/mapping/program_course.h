#pragma once
// The course of a log through its program: whether it runs from the start, once, without a stop.

#include <span>

#include "log/log.h"
#include "mapping/line_map.h"
#include "mapping/program_runs.h"

namespace clsurf {

/// Reports deviations from a single, complete run:
/// - map.begins-inside, map.ends-early: the log has a part of the program only (warnings)
/// - map.runs: the program begins again: two runs in one file (a warning)
/// - map.restart: a run continues from an earlier line: the lines in between ran twice (a warning)
/// - map.pause: the tool is at rest for more than a second on a line that cuts
/// Returns the share of the program's motions before and after the log, 0 … 1; 0 if only an approach and
/// a retract are missing. `runs`: from find_program_runs(). O(points).
double note_course(const Trajectory& path, const Log& log, const Program& program, const LineMap& map,
                   std::span<const ProgramRun> runs, Diagnostics& diagnostics);

}  // namespace clsurf

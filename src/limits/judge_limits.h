#pragma once
// Compares every record of a log with the limits of a machine file or a budget.

#include <span>

#include "limits/limit_report.h"
#include "limits/motion_window.h"
#include "log/log.h"
#include "mapping/line_map.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// The compared data: `path` has the commanded positions, in the coordinates of the program's motions.
struct LimitedRun {
    const Log& log;
    const Trajectory& path;
    const Program& program;  ///< may have no motions
    const LineMap& lines;
};

/// Judges every limit for which the log has the positions; the diagnostics list the others. O(records · limits), parallel.
[[nodiscard]] LimitReport judge_limits(const LimitedRun& run, std::span<const StatedLimit> limits);

}  // namespace clsurf

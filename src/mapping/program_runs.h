#pragma once
// The runs of a program in one log: several parts cut one after the other, or a run that was stopped and restarted
// from an earlier line.

#include <span>
#include <vector>

#include "mapping/line_map.h"
#include "toolpath/trajectory.h"

namespace clsurf {

struct ProgramRun {
    PointIndex first = 0;           ///< its first point
    std::int64_t first_motion = 0;  ///< first of its motions, both ends included …
    std::int64_t last_motion = -1;  ///< … last < first: none
};

/// At least one, in order. A run begins where the log goes back in the program and then executes cutting motions that the
/// previous run already had: a flickering number begins no run. O(points).
[[nodiscard]] std::vector<ProgramRun> find_program_runs(const LineMap& lines);

/// For each run but the first: the points just before it at which the tool is off the program's path, returning to the
/// point of continuation. Empty if there are none. O(points).
[[nodiscard]] std::vector<PointRange> find_returns(const Trajectory& path, const Program& program, const LineMap& lines,
                                                   std::span<const ProgramRun> runs);

}  // namespace clsurf

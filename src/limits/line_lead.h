#pragma once
// Number of records by which the lines that a kernel reports lead its positions: the planner is ahead of the interpolator.

#include "mapping/line_map.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

// Twice the lead of LinuxCNC (docs/limits.md#how-certain).
inline constexpr PointIndex longest_line_lead = 4;

/// The lead for which positions are nearest to the motions of their lines, on at most 10^5 records; 0 if lines were found
/// by geometry.
[[nodiscard]] PointIndex find_line_lead(const Trajectory& path, const Program& program, const LineMap& lines);

}  // namespace clsurf

#pragma once
// The motion of each point of a log that gives its line, if a line has several motions: it runs repeatedly (loops,
// subprograms), it is a canned cycle of rapids and feeds, or files of subprograms have the same line numbers. The
// runs of the log are matched with those of the program in their order, and checked against the geometry.

#include <cstdint>

#include "core/column.h"
#include "core/point.h"
#include "log/log.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Whether line numbers do not determine motions: then track_motions() is needed. O(motions).
[[nodiscard]] bool lines_are_ambiguous(const Motions& motions);

/// The motion of each point; LineMap::no_motion: none. `log` has the channel `line`; if it names its programs, a line
/// belongs to the file of that name only. `tolerance` [mm]: if a point is farther off its motions, the line is
/// searched for elsewhere in the program. O(points + motions).
[[nodiscard]] Column<std::uint32_t> track_motions(const Trajectory& path, const Log& log, const Program& program,
                                                  const ChannelView& lines, double tolerance);

}  // namespace clsurf

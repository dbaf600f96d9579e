#pragma once
// Which motion each point of a log is on, where the log gives its line and a line has several motions:
// it runs again and again (loops, subprograms), it is a canned cycle of rapids and feeds, or files of
// subprograms have lines of the same number. The runs of the log are matched with those of the program in
// their order, and held against the geometry.

#include <cstdint>

#include "core/column.h"
#include "core/point.h"
#include "log/log.h"
#include "program/program.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// True where a line number does not tell the motion: track_motions() is needed. O(motions).
[[nodiscard]] bool lines_are_ambiguous(const Motions& motions);

/// The motion of each point; LineMap::no_motion: none. `log` has the channel `line`; where it names its programs,
/// a line belongs to the file of that name only. `tolerance` [mm]: how far a point may be off its motions
/// before the line is looked for elsewhere in the program. O(points + motions).
[[nodiscard]] Column<std::uint32_t> track_motions(const Trajectory& path, const Log& log, const Program& program,
                                                  const ChannelView& lines, double tolerance);

}  // namespace clsurf

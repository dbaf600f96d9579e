#pragma once
// The lines of a log's points: from its line channel, moved where the program was edited, or by alignment.

#include "mapping/line_map.h"

namespace clsurf {

/// The lines of a log: its channel where it has one (and `use_channel`), an alignment otherwise. Where
/// the log names several programs, lines of the others are not taken for this one's. Where the program was edited
/// after the run (`identity`, or lines that lie beside their motions all along), the log's lines are moved to where
/// they stand now (mapping/line_edits.h). match() of the result says whether the log belongs to the program.
/// Adds diagnostics `map.…` about disagreement; where most points are off by the same translation,
/// `map.work-offset` with the offset that brings them onto the path.
[[nodiscard]] LineMap map_lines(const Trajectory& path, const Log& log, const Program& program, bool use_channel,
                                Diagnostics& diagnostics, ProgramIdentity identity = ProgramIdentity::unknown);

}  // namespace clsurf

#pragma once
// The lines of a log's points: from its line channel, corrected if the program was edited, or by alignment.

#include "mapping/line_map.h"

namespace clsurf {

/// The lines of a log: from its channel if it has one (and `use_channel`), else by alignment. If the log names
/// several programs, lines of the others are not used for this one. If the program was edited after the run
/// (`identity`, or lines that are consistently off their motions), the log's lines are converted to the new text
/// (mapping/line_edits.h). match() of the result says whether the log belongs to the program. Adds diagnostics
/// `map.…` about disagreement; if most points are off by the same translation, `map.work-offset` with the offset that
/// brings them onto the path.
[[nodiscard]] LineMap map_lines(const Trajectory& path, const Log& log, const Program& program, bool use_channel,
                                Diagnostics& diagnostics, ProgramIdentity identity = ProgramIdentity::unknown);

}  // namespace clsurf
